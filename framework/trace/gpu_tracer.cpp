#include "trace/gpu_tracer.h"

#include <algorithm>

#include "base/error.h"

namespace voxray {
namespace {

/// Rays of one launch: every device takes that many, in work groups of 64 too.
constexpr uint32_t kRaysPerLaunch = 65535u * 64u;

}  // namespace

void checkStream(const Buffer& rays, const Buffer& results, uint64_t resultBytes, uint32_t count) {
    if (rays.bytes() < count * sizeof(Ray))
        throw Error("buffer '{}' holds {} rays, {} are to be traced", rays.name(), rays.bytes() / sizeof(Ray),
                    count);
    if (results.bytes() < count * resultBytes)
        throw Error("buffer '{}' has room for {} results of {} rays", results.name(),
                    results.bytes() / resultBytes, count);
}

GpuTracer::GpuTracer(Device& device, const SceneState& state, uint32_t trianglesPerChunk)
    : device_(device), state_(state), order_(tracingOrder(state, trianglesPerChunk)) {
    CommandStream stream(device);
    structure_ = buildSceneStructure(device, stream, state, order_);
    mask_ = makeGpuAlphaMask(device, stream, state, order_);
    stream.finish();
}

void GpuTracer::update(CommandStream& stream) {
    const auto& [opaque, masked] = order_.moving;
    if (opaque.first == opaque.end && masked.first == masked.end) return;
    stream.finish();
    sortMoving(state_, order_);
    updateSceneStructure(device_, stream, state_, order_, structure_);
    if (masked.first < masked.end) mask_ = makeGpuAlphaMask(device_, stream, state_, order_);
    stream.finish();
}

void GpuTracer::closestHit(CommandStream& stream, const Buffer& rays, const Buffer& hits, uint32_t count) {
    checkStream(rays, hits, sizeof(Hit), count);
    trace(stream, false, rays, hits, count);
}

void GpuTracer::occluded(CommandStream& stream, const Buffer& rays, const Buffer& results, uint32_t count) {
    checkStream(rays, results, sizeof(uint32_t), count);
    trace(stream, true, rays, results, count);
}

void GpuTracer::trace(CommandStream& stream, bool occluded, const Buffer& rays, const Buffer& results,
                      uint32_t count) {
    gpu::TraceCall call{};
    call.rays = rays.address();
    call.results = results.address();
    call.chunkFirst = structure_.chunkFirst.address();
    call.triangleIds = structure_.triangleIds.address();
    call.corners = structure_.corners.address();
    call.positions = structure_.positions.address();
    call.maskedTriangles = mask_.triangles.address();
    call.alphaMaterials = mask_.materials.address();
    call.alphaTexels = mask_.texels.address();
    call.opaqueCount = structure_.opaqueCount;
    for (uint32_t first = 0; first < count; first = call.endRay) {
        call.firstRay = first;
        call.endRay = first + std::min(kRaysPerLaunch, count - first);
        launch(stream, occluded, call);
    }
    raysTraced_ += count;
}

}  // namespace voxray
