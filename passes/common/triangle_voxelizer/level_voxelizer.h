#pragma once

#include <span>
#include <vector>

#include "graph/pass.h"
#include "shaders/voxels/voxel_types.h"

namespace voxray {

/// What makeSampledAxisVoxelizer(8) finds, in several grids by one draw: each triangle has an instance of the
/// geometry shader and a viewport for each grid (Arnebäck 2017, section 4.2).
class LevelVoxelizer {
 public:
    /// @param shader as of TriangleVoxelizer::makeProgram(). Its fragments have the number of their grid, `level`.
    LevelVoxelizer(ProgramOwner& owner, const std::string& shader, const Defines& defines);

    /// @param levels how many grids there are. @throws Error naming a feature that the device lacks.
    void plan(PassPlan& plan, uint32_t levels);
    /// Rasterizes into `levels` grids: their voxels from grid.first up to grid.resolution, none where grid.first
    /// is not below. @param triangles that may reach any of them. @param bindings, fixedPointScale as of
    /// TriangleVoxelizer::run().
    void run(PassContext& context, std::span<const gpu::VoxelGrid> grids, const std::vector<uint32_t>& triangles,
             std::span<const Binding> bindings, float fixedPointScale) const;

 private:
    RasterPipeline program_;
    Buffer drawn_, grids_;
};

}  // namespace voxray
