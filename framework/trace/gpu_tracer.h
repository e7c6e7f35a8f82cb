#pragma once

#include "shaders/trace/trace_types.h"
#include "trace/acceleration_structure.h"
#include "trace/counted_rays.h"
#include "trace/gpu_alpha_mask.h"
#include "trace/ray_tracer.h"

namespace voxray {

/// Base of both GPU backends: the scene's acceleration structures, and streams in launches of the size that a
/// device allows.
class GpuTracer : public RayTracer, public CountedRayTracer {
 public:
    using RayTracer::closestHit;
    using RayTracer::occluded;
    void closestHit(CommandStream& stream, const Buffer& rays, const Buffer& hits, const CountedRays& count) final;
    void occluded(CommandStream& stream, const Buffer& rays, const Buffer& results, const CountedRays& count) final;
    size_t memoryBytes() const final { return structure_.bytes(); }

 protected:
    GpuTracer(Device& device, const SceneState& state, uint32_t trianglesPerChunk);

    /// Traces `count` rays of a stream. @param call bindings of shaders/trace/trace.glsl and the top-level
    /// structure.
    virtual void launch(CommandStream& stream, bool occluded, uint32_t count, const Bindings& call) = 0;
    /// The same for rays that the device counts.
    virtual void launchCounted(CommandStream& stream, bool occluded, const CountedRays& count,
                               const Bindings& call) = 0;

 private:
    void updateStructure(CommandStream& stream) final;
    void trace(CommandStream& stream, Query query, const Buffer& rays, const Buffer& results, uint32_t count,
               Coherence coherence) final;
    void traceCounted(CommandStream& stream, Query query, const Buffer& rays, const Buffer& results,
                      const CountedRays& count);
    /// Bindings of a launch of the rays from `first` to before `end`. @param counted address of the number of
    /// rays, 0: `end`.
    Bindings call(const Buffer& rays, const Buffer& results, uint32_t first, uint32_t end, uint64_t counted) const;

    Device& device_;
    const SceneState& state_;
    TracingOrder order_;
    SceneStructure structure_;
    GpuAlphaMask mask_;
};

}  // namespace voxray
