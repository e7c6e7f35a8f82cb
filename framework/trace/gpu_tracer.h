#pragma once

#include "shaders/trace/trace_types.h"
#include "trace/acceleration_structure.h"
#include "trace/gpu_alpha_mask.h"
#include "trace/ray_tracer.h"

namespace voxray {

/// Base of both GPU backends: the scene's acceleration structures, and streams in launches of the size that a
/// device allows.
class GpuTracer : public RayTracer {
 public:
    size_t memoryBytes() const final { return structure_.bytes(); }

 protected:
    GpuTracer(Device& device, const SceneState& state, uint32_t trianglesPerChunk);

    /// Traces `count` rays of a stream. @param call bindings of shaders/trace/trace.glsl and the top-level
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
