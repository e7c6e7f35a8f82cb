#include "trace/gpu_tracer.h"

#include <algorithm>
#include <cstddef>

#include "shaders/trace/stream_count.h"

namespace voxray {
namespace {

/// Rays of one launch: a row of work groups of 64.
constexpr uint32_t kRaysPerLaunch = CountedRays::kMost;

}  // namespace

GpuTracer::GpuTracer(Device& device, const SceneState& state, uint32_t trianglesPerChunk)
    : device_(device), state_(state), order_(tracingOrder(state, trianglesPerChunk)) {
    CommandStream stream(device);
    structure_ = buildSceneStructure(device, stream, state, order_);
    mask_ = makeGpuAlphaMask(device, stream, state, order_);
    stream.finish();
}

void GpuTracer::updateStructure(CommandStream& stream) {
    const auto& [opaque, masked] = order_.moving;
    if (opaque.first == opaque.end && masked.first == masked.end) return;
    stream.finish();
    sortMoving(state_, order_);
    updateSceneStructure(device_, stream, state_, order_, structure_);
    if (masked.first < masked.end) mask_ = makeGpuAlphaMask(device_, stream, state_, order_);
    stream.finish();
}

Bindings GpuTracer::call(const Buffer& rays, const Buffer& results, uint32_t first, uint32_t end,
                         uint64_t counted) const {
    return {{"structure", structure_.top.handle()},
            {"rays", rays.address()},
            {"results", results.address()},
            {"chunkFirst", structure_.chunkFirst.address()},
            {"triangleIds", structure_.triangleIds.address()},
            {"corners", structure_.corners.address()},
            {"positions", structure_.positions.address()},
            {"maskedTriangles", mask_.triangles.address()},
            {"alphaMaterials", mask_.materials.address()},
            {"alphaTexels", mask_.texels.address()},
            {"counted", counted},
            {"firstRay", first},
            {"endRay", end},
            {"opaqueCount", structure_.opaqueCount}};
}

void GpuTracer::trace(CommandStream& stream, Query query, const Buffer& rays, const Buffer& results, uint32_t count,
                      Coherence) {
    for (uint32_t first = 0; first < count; first += kRaysPerLaunch) {
        const uint32_t launched = std::min(kRaysPerLaunch, count - first);
        launch(stream, query == Query::Occluded, launched, call(rays, results, first, first + launched, 0));
    }
}

void GpuTracer::closestHit(CommandStream& stream, const Buffer& rays, const Buffer& hits, const CountedRays& count) {
    traceCounted(stream, Query::ClosestHit, rays, hits, count);
}

void GpuTracer::occluded(CommandStream& stream, const Buffer& rays, const Buffer& results, const CountedRays& count) {
    traceCounted(stream, Query::Occluded, rays, results, count);
}

void GpuTracer::traceCounted(CommandStream& stream, Query query, const Buffer& rays, const Buffer& results,
                             const CountedRays& count) {
    const uint64_t counted =
        count.counts.address() + count.index * sizeof(gpu::StreamCount) + offsetof(gpu::StreamCount, count);
    launchCounted(stream, query == Query::Occluded, count, call(rays, results, 0, count.most, counted));
}

}  // namespace voxray
