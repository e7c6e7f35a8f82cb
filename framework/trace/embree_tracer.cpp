#include "trace/embree_tracer.h"

#include <algorithm>

#include "base/interrupt.h"

namespace voxray {
namespace {

/// Rays between checks for an interrupt, and per staged copy.
constexpr uint32_t kRaysPerBatch = 1u << 20;

}  // namespace

template <typename Result>
void EmbreeTracer::trace(CommandStream& stream, const Buffer& rays, const Buffer& results, uint32_t count,
                         const std::function<void(std::span<const Ray>, std::span<Result>)>& traceRays) {
    stream.finish();
    const bool isMapped = rays.mapped() && results.mapped();
    for (uint32_t first = 0, batch = 0; first < count; first += batch) {
        if (interruptRequested()) throw Interrupted();
        batch = std::min(kRaysPerBatch, count - first);
        if (isMapped) {
            traceRays(rays.mappedAs<const Ray>().subspan(first, batch),
                      results.mappedAs<Result>().subspan(first, batch));
            continue;
        }

        const std::vector<std::byte> bytes = stream.read(rays, batch * sizeof(Ray), first * sizeof(Ray));
        std::vector<Result> traced(batch);
        traceRays({reinterpret_cast<const Ray*>(bytes.data()), batch}, traced);
        stream.upload(results, std::as_bytes(std::span(traced)), first * sizeof(Result));
    }
}

void EmbreeTracer::trace(CommandStream& stream, Query query, const Buffer& rays, const Buffer& results, uint32_t count,
                         Coherence coherence) {
    if (query == Query::ClosestHit)
        trace<Hit>(stream, rays, results, count,
                   [&](auto batchRays, auto hits) { scene_.closestHit(batchRays, hits, coherence); });
    else
        trace<uint32_t>(stream, rays, results, count,
                        [&](auto batchRays, auto occluded) { scene_.occluded(batchRays, occluded, coherence); });
}

void EmbreeTracer::updateStructure(CommandStream& stream) {
    stream.finish();
    scene_.update();
}

}  // namespace voxray
