#include "passes/path_trace/path_trace_device/device_lights.h"

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

}  // namespace

void DeviceLights::plan(PassPlan& plan) {
    const SceneState& state = *plan.frame.scene;
    const uint64_t patches = emissiveTriangles(state);
    plan.buffer(bins_, "distribution of lights", (state.lights.size() + 1 + patches) * sizeof(gpu::LightBin));
    plan.buffer(patches_, "emissive patches", std::max<uint64_t>(patches, 1) * sizeof(gpu::LightPatch));
    plan.buffer(trianglePatches_, "patches of triangles",
                std::max<uint64_t>(state.geometry.triangles.size(), 1) * sizeof(uint32_t));
    sceneVersion_.reset();
}

void DeviceLights::update(PassContext& context) {
    if (sceneVersion_ == context.frame.sceneVersion) return;
    sceneVersion_ = context.frame.sceneVersion;
    const SceneState& state = *context.frame.scene;
    path_trace::SurfaceTable surfaces(state, ExpectedRays::Few);
    const path_trace::LightTable table(state, surfaces);

    std::vector<gpu::LightBin> bins;
    for (const auto& bin : table.distribution().bins()) bins.push_back({bin.threshold, bin.alias, bin.probability});
    std::vector<gpu::LightPatch> patches;
    std::vector<uint32_t> trianglePatches(state.geometry.triangles.size(), NO_PATCH);
    for (const auto& patch : table.patches()) {
        for (uint32_t t = patch.triangle; t <= patch.triangle + (patch.isParallelogram ? 1 : 0); ++t)
            trianglePatches[t] = uint32_t(patches.size());
        patches.push_back({patch.triangle, patch.isParallelogram ? 1u : 0u, patch.pdf});
    }
    lights_ = {uint32_t(bins.size()), table.environmentIndex(), table.isSingle() ? 1u : 0u, table.canBeHit() ? 1u : 0u};
    context.stream.upload(bins_, bins);
    context.stream.upload(patches_, patches);
    context.stream.upload(trianglePatches_, trianglePatches);
}

}  // namespace voxray
