#include "passes/common/triangle_voxelizer/level_voxelizer.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/gtx/component_wise.hpp>

#include "base/error.h"

namespace voxray {

LevelVoxelizer::LevelVoxelizer(ProgramOwner& owner, const std::string& shader, const Defines& defines)
    : program_(owner,
               {"passes/common/triangle_voxelizer/dominant_axis.vert",
                "passes/common/triangle_voxelizer/dominant_axis.geom", shader + ".frag"},
               RasterState{}, defines) {}

void LevelVoxelizer::plan(PassPlan& plan, uint32_t levels) {
    if (!plan.device.geometryShader || plan.device.viewports < levels)
        throw Error(
            "rasterization of {} levels by one draw needs geometry shaders (geometryShader) and as many viewports "
            "(multiViewport, maxViewports), which device '{}' lacks",
            levels, plan.device.name);
    program_.define({{"SAMPLED_AXIS", "1"}, {"LEVELS", std::to_string(levels)}});
    RasterState state;
    state.viewports = levels;
    program_.setState(state);
    const size_t triangles = plan.frame.scene->geometry.triangles.size();
    plan.scratchBuffer(drawn_, "triangles to draw", std::max<size_t>(triangles, 1) * sizeof(uint32_t));
    plan.scratchBuffer(grids_, "grids of the levels", levels * sizeof(gpu::VoxelGrid));
}

void LevelVoxelizer::run(PassContext& context, std::span<const gpu::VoxelGrid> grids,
                         const std::vector<uint32_t>& triangles, std::span<const Binding> bindings,
                         float fixedPointScale) const {
    RasterTargets targets;
    for (const gpu::VoxelGrid& grid : grids) {
        // One square image holds the columns along any axis
        const int side = glm::compMax(glm::ivec3(grid.resolution) - glm::ivec3(grid.first));
        targets.viewports.emplace_back(glm::uvec2(uint32_t(std::max(side, 1))));
        targets.extent = {glm::max(glm::uvec2(targets.extent), targets.viewports.back()), 1};
    }
    context.stream.upload(drawn_, triangles);
    context.stream.upload(grids_, std::as_bytes(grids));
    std::vector<Binding> all = context.scene.bindings();
    all.insert(all.end(), bindings.begin(), bindings.end());
    context.stream.draw(program_, targets, uint32_t(3 * triangles.size()),
                        {all,
                         {"drawnTriangles", drawn_},
                         {"levelGrids", grids_},
                         {"grid", grids.front()},
                         {"fixedPointScale", fixedPointScale},
                         {"tiles", 0u},
                         {"axis", 0u},
                         {"samples", 8u}});
}

}  // namespace voxray
