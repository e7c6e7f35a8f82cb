#include "trace/gpu_tracer.h"

#include <algorithm>

namespace voxray {
namespace {

/// Rays of one launch: every device takes that many, in work groups of 64 too.
constexpr uint32_t kRaysPerLaunch = 65535u * 64u;

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

void GpuTracer::trace(CommandStream& stream, Query query, const Buffer& rays, const Buffer& results,
                      uint32_t count, Coherence) {
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
        launch(stream, query == Query::Occluded, call);
    }
}

}  // namespace voxray
