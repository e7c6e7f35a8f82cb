#include "trace/gpu_tracer.h"

#include <algorithm>

namespace voxray {
namespace {

/// Rays of one launch: a row of work groups of 64.
constexpr uint32_t kRaysPerLaunch = 32768u * 64u;

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

void GpuTracer::trace(CommandStream& stream, Query query, const Buffer& rays, const Buffer& results, uint32_t count,
                      Coherence) {
    for (uint32_t first = 0; first < count; first += kRaysPerLaunch) {
        const uint32_t launched = std::min(kRaysPerLaunch, count - first);
        launch(stream, query == Query::Occluded, launched,
               {{"structure", structure_.top.handle()},
                {"rays", rays.address()},
                {"results", results.address()},
                {"chunkFirst", structure_.chunkFirst.address()},
                {"triangleIds", structure_.triangleIds.address()},
                {"corners", structure_.corners.address()},
                {"positions", structure_.positions.address()},
                {"maskedTriangles", mask_.triangles.address()},
                {"alphaMaterials", mask_.materials.address()},
                {"alphaTexels", mask_.texels.address()},
                {"firstRay", first},
                {"endRay", first + launched},
                {"opaqueCount", structure_.opaqueCount}});
    }
}

}  // namespace voxray
