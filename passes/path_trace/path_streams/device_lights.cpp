#include "passes/path_trace/path_streams/device_lights.h"

#include <algorithm>
#include <glm/common.hpp>

#include "passes/path_trace/lights.h"

namespace voxray {
namespace {

/// Triangles whose material may emit.
uint64_t emissiveTriangles(const SceneState& state) {
    return uint64_t(std::ranges::count_if(state.geometry.triangleMaterials, [&](uint32_t material) {
        const glm::vec3& e = state.scene->materials[material].emission;
        return std::max({e.r, e.g, e.b}) > 0.0f;
    }));
}

uint32_t factsOf(const path_trace::SurfaceTable& surfaces, uint32_t triangle) {
    const path_trace::SurfaceTriangle t = surfaces.triangle(triangle);
    const bool isSimple = t.isSimple != 0 && surfaces.material(t).emissiveTexture.texture < 0;
    return (t.light == path_trace::kNoLight ? NO_PATCH : t.light) | (isSimple ? IS_SIMPLE : 0u);
}

}  // namespace

void DeviceLights::plan(PassPlan& plan) {
    const SceneState& state = *plan.frame.scene;
    const uint64_t patches = emissiveTriangles(state);
    plan.buffer(bins_, "distribution of lights", (state.lights.size() + 1 + patches) * sizeof(gpu::LightBin));
    plan.buffer(patches_, "emissive patches", std::max<uint64_t>(patches, 1) * sizeof(gpu::LightPatch));
    plan.buffer(triangleFacts_, "facts of triangles",
                std::max<uint64_t>(state.geometry.triangles.size(), 1) * sizeof(uint32_t));
    sceneVersion_.reset();
}

void DeviceLights::update(PassContext& context) {
    if (sceneVersion_ == context.frame.sceneVersion) return;
    sceneVersion_ = context.frame.sceneVersion;
    const SceneState& state = *context.frame.scene;
    path_trace::SurfaceTable surfaces(state, ExpectedRays::Many);
    const path_trace::LightTable table(state, surfaces);

    std::vector<gpu::LightBin> bins;
    for (const auto& bin : table.distribution().bins()) bins.push_back({bin.threshold, bin.alias, bin.probability});
    std::vector<gpu::LightPatch> patches;
    for (const auto& patch : table.patches())
        patches.push_back({patch.triangle, patch.isParallelogram ? 1u : 0u, patch.pdf});
    std::vector<uint32_t> facts(state.geometry.triangles.size());
    for (uint32_t t = 0; t < facts.size(); ++t) facts[t] = factsOf(surfaces, t);
    lights_ = {uint32_t(bins.size()), table.environmentIndex(), table.isSingle() ? 1u : 0u, table.canBeHit() ? 1u : 0u};
    context.stream.upload(bins_, bins);
    context.stream.upload(patches_, patches);
    context.stream.upload(triangleFacts_, facts);
}

}  // namespace voxray
