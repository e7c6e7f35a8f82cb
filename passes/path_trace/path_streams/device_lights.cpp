#include "passes/path_trace/path_streams/device_lights.h"

#include <algorithm>
#include <glm/common.hpp>

#include "passes/path_trace/lights.h"

namespace voxray {
namespace {

static_assert(NO_LEAF == path_trace::LightTable::kNoLeaf && ENVIRONMENT_LIGHT == path_trace::LightTable::kEnvironment);

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
    plan.buffer(tree_, "light tree of paths",
                lightTreeNodes(state.lights.size() + patches) * sizeof(gpu::LightTreeNode));
    plan.buffer(infinite_, "infinite lights", (state.lights.size() + 1) * sizeof(uint32_t));
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

    std::vector<gpu::LightPatch> patches;
    for (const auto& patch : table.patches())
        patches.push_back({patch.triangle, patch.isParallelogram ? 1u : 0u, patch.inverseArea, patch.leaf});
    const std::vector<uint32_t> infinite(table.infinite().begin(), table.infinite().end());
    std::vector<uint32_t> facts(state.geometry.triangles.size());
    for (uint32_t t = 0; t < facts.size(); ++t) facts[t] = factsOf(surfaces, t);
    const LightTree& tree = table.tree();
    lights_ = {uint32_t(tree.nodes().size()), uint32_t(state.lights.size()), uint32_t(infinite.size()),
               float(tree.intensity()),       table.environmentIrradiance(), table.isSingle() ? 1u : 0u,
               table.canBeHit() ? 1u : 0u};
    context.stream.upload(tree_, tree.nodes());
    context.stream.upload(infinite_, infinite);
    context.stream.upload(patches_, patches);
    context.stream.upload(triangleFacts_, facts);
}

}  // namespace voxray
