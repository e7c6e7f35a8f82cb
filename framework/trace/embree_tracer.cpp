#include "trace/embree_tracer.h"

#include <algorithm>

#include "trace/gpu_tracer.h"

namespace voxray {
namespace {

/// Rays of one staged copy.
constexpr uint32_t kRaysPerCopy = 1u << 20;

}  // namespace

template <typename Result>
void EmbreeTracer::trace(CommandStream& stream, const Buffer& rays, const Buffer& results, uint32_t count,
                         void (EmbreeScene::*function)(std::span<const Ray>, std::span<Result>) const) {
    checkStream(rays, results, sizeof(Result), count);
    raysTraced_ += count;
    stream.finish();
    if (rays.mapped() && results.mapped()) {
        (scene_.*function)(rays.mappedAs<const Ray>().first(count), results.mappedAs<Result>().first(count));
        return;
    }

    // Device memory that the host doesn't see: read, trace and upload part by part.
    for (uint32_t first = 0; first < count; first += std::min(kRaysPerCopy, count - first)) {
        const uint32_t part = std::min(kRaysPerCopy, count - first);
        const std::vector<std::byte> bytes = stream.read(rays, part * sizeof(Ray), first * sizeof(Ray));
        std::vector<Result> traced(part);
        (scene_.*function)({reinterpret_cast<const Ray*>(bytes.data()), part}, traced);
        stream.upload(results, std::as_bytes(std::span(traced)), first * sizeof(Result));
    }
}

void EmbreeTracer::closestHit(CommandStream& stream, const Buffer& rays, const Buffer& hits, uint32_t count) {
    trace<Hit>(stream, rays, hits, count, &EmbreeScene::closestHit);
}

void EmbreeTracer::occluded(CommandStream& stream, const Buffer& rays, const Buffer& results,
                            uint32_t count) {
    trace<uint32_t>(stream, rays, results, count, &EmbreeScene::occluded);
}

void EmbreeTracer::update(CommandStream& stream) {
    stream.finish();
    scene_.update();
}

}  // namespace voxray
