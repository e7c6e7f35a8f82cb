#pragma once

#include "shaders/trace/trace_types.h"
#include "trace/acceleration_structure.h"
#include "trace/gpu_alpha_mask.h"
#include "trace/ray_tracer.h"

namespace voxray {

/// What both GPU backends share: the scene's structures, and launches over parts of a stream that a device
/// can take in one.
class GpuTracer : public RayTracer {
 public:
    size_t memoryBytes() const final { return structure_.bytes(); }

 protected:
    GpuTracer(Device& device, const SceneState& state, uint32_t trianglesPerChunk);

    /// Traces `count` rays of a stream. @param call what shaders/trace/trace.glsl declares, and the
    /// structure.
    virtual void launch(CommandStream& stream, bool occluded, uint32_t count, const Bindings& call) = 0;

 private:
    void updateStructure(CommandStream& stream) final;
    void trace(CommandStream& stream, Query query, const Buffer& rays, const Buffer& results, uint32_t count,
               Coherence coherence) final;

    Device& device_;
    const SceneState& state_;
    TracingOrder order_;
    SceneStructure structure_;
    GpuAlphaMask mask_;
};

}  // namespace voxray
