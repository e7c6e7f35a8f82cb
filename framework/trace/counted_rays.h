#pragma once

#include <cstdint>

#include "trace/ray_tracer.h"

namespace voxray {

/// The length of a stream that the device counts: element `index` of a buffer of gpu::StreamCount
/// (shaders/trace/stream_count.h), at most `most` when the commands run.
struct CountedRays {
    static constexpr uint32_t kMost = 32768u * 64u;
    const Buffer& counts;
    uint32_t index;
    uint32_t most;  ///< Up to kMost.
};

/// A tracer that takes the length of a stream from the device.
class CountedRayTracer {
 public:
    virtual ~CountedRayTracer() = default;
    virtual void closestHit(CommandStream& stream, const Buffer& rays, const Buffer& hits,
                            const CountedRays& count) = 0;
    virtual void occluded(CommandStream& stream, const Buffer& rays, const Buffer& results,
                          const CountedRays& count) = 0;
};

/// Whether the host waits for the device at each stream, and so may read its counts as well.
bool waitsForCounts(const RayTracer& tracer);

/// As RayTracer::closestHit() and occluded(), of streams whose length the device counts. For tracers that can't
/// take it from there, such as Embree, the host waits for it. raysTraced() leaves out what it doesn't know.
/// @throws Error also for a stream of more than CountedRays::kMost rays.
void closestHit(RayTracer& tracer, CommandStream& stream, const Buffer& rays, const Buffer& hits,
                const CountedRays& count, Coherence coherence = Coherence::Incoherent);
void occluded(RayTracer& tracer, CommandStream& stream, const Buffer& rays, const Buffer& results,
              const CountedRays& count, Coherence coherence = Coherence::Incoherent);

}  // namespace voxray
