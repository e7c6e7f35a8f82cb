#include "trace/embree_tracer.h"

#include <algorithm>

#include "base/interrupt.h"

namespace voxray {
namespace {

/// Rays between two looks for an interrupt, and of one staged copy.
constexpr uint32_t kRaysPerPart = 1u << 20;

}  // namespace

template <typename Result>
void EmbreeTracer::trace(CommandStream& stream, const Buffer& rays, const Buffer& results, uint32_t count,
                         const std::function<void(std::span<const Ray>, std::span<Result>)>& traceRays) {
    stream.finish();
    const bool isMapped = rays.mapped() && results.mapped();
    for (uint32_t first = 0, part = 0; first < count; first += part) {
        if (interruptRequested()) throw Interrupted();
        part = std::min(kRaysPerPart, count - first);
        if (isMapped) {
            traceRays(rays.mappedAs<const Ray>().subspan(first, part),
                      results.mappedAs<Result>().subspan(first, part));
            continue;
        }

        // Device memory that the host doesn't see
        const std::vector<std::byte> bytes = stream.read(rays, part * sizeof(Ray), first * sizeof(Ray));
        std::vector<Result> traced(part);
        traceRays({reinterpret_cast<const Ray*>(bytes.data()), part}, traced);
        stream.upload(results, std::as_bytes(std::span(traced)), first * sizeof(Result));
    }
}

void EmbreeTracer::trace(CommandStream& stream, Query query, const Buffer& rays, const Buffer& results,
                         uint32_t count, Coherence coherence) {
    if (query == Query::ClosestHit)
        trace<Hit>(stream, rays, results, count,
                   [&](auto from, auto to) { scene_.closestHit(from, to, coherence); });
    else
        trace<uint32_t>(stream, rays, results, count,
                        [&](auto from, auto to) { scene_.occluded(from, to, coherence); });
}

void EmbreeTracer::updateStructure(CommandStream& stream) {
    stream.finish();
    scene_.update();
}

}  // namespace voxray
