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

    /// Traces rays [call.firstRay, call.endRay).
    virtual void launch(CommandStream& stream, bool occluded, const gpu::TraceCall& call) = 0;

    VkAccelerationStructureKHR structure() const { return structure_.top.handle(); }

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
