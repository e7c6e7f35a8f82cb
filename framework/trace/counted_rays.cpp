#include "trace/counted_rays.h"

#include <algorithm>
#include <cstring>

#include "base/error.h"
#include "shaders/trace/stream_count.h"

namespace voxray {
namespace {

/// @throws Error if a stream is too long or its buffers are too small.
void checkCount(const Buffer& rays, const Buffer& results, uint64_t resultBytes, const CountedRays& count) {
    if (count.most > CountedRays::kMost)
        throw Error("a stream of up to {} rays is to be counted on the device, {} are possible", count.most,
                    CountedRays::kMost);
    if (rays.bytes() < count.most * sizeof(Ray) || results.bytes() < count.most * resultBytes)
        throw Error("buffers '{}' and '{}' have no room for a stream of up to {} rays", rays.name(), results.name(),
                    count.most);
}

uint32_t readCount(CommandStream& stream, const CountedRays& count) {
    gpu::StreamCount read;
    const std::vector<std::byte> bytes = stream.read(count.counts, sizeof(read), count.index * sizeof(read));
    std::memcpy(&read, bytes.data(), sizeof(read));
    return std::min(read.count, count.most);
}

}  // namespace

bool waitsForCounts(const RayTracer& tracer) {
    return dynamic_cast<const CountedRayTracer*>(&tracer) == nullptr;
}

void closestHit(RayTracer& tracer, CommandStream& stream, const Buffer& rays, const Buffer& hits,
                const CountedRays& count, Coherence coherence) {
    checkCount(rays, hits, sizeof(Hit), count);
    if (auto* counted = dynamic_cast<CountedRayTracer*>(&tracer))
        counted->closestHit(stream, rays, hits, count);
    else
        tracer.closestHit(stream, rays, hits, readCount(stream, count), coherence);
}

void occluded(RayTracer& tracer, CommandStream& stream, const Buffer& rays, const Buffer& results,
              const CountedRays& count, Coherence coherence) {
    checkCount(rays, results, sizeof(uint32_t), count);
    if (auto* counted = dynamic_cast<CountedRayTracer*>(&tracer))
        counted->occluded(stream, rays, results, count);
    else
        tracer.occluded(stream, rays, results, readCount(stream, count), coherence);
}

}  // namespace voxray
