#pragma once

#include <memory>
#include <optional>
#include <string>
#include <tuple>

#include "passes/common/compute/prefix_sum.h"
#include "passes/common/triangle_walk/voxelize_method.h"
#include "passes/common/voxel_builder/region_merge.h"
#include "passes/common/voxel_builder/visibility_probe.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {

/// The parameters of a pass that voxelizes; it adds schema() to its own with std::tuple_cat.
struct VoxelBuildParams {
    uint32_t directions = 6;
    uint32_t visibilityRays = 8;
    static constexpr auto schema() {
        return std::tuple{
            field("directions", &VoxelBuildParams::directions,
                  "6: a voxel keeps light apart by the side that surfaces face. 1: all of a voxel shares one "
                  "value, so that both sides of a thin wall mix.",
                  1u, 6u),
            field("visibility_rays", &VoxelBuildParams::visibilityRays,
                  "Points on a surface as large as a voxel's face that probe both sides for open space; 0 "
                  "takes all sides for exposed, which darkens thin closed walls.",
                  0u, 256u)};
    }
    /// @throws Error naming `pass` where directions is neither 1 nor 6.
    void check(const std::string& pass) const;
};

/// Makes surface voxels of triangles. A method finds the voxels, twice: first to mark them, then, once they
/// are numbered, to sum up what their surfaces carry, weighted by area. Sums are integers: the result does
/// not depend on the order of additions.
class VoxelBuilder {
 public:
    /// @param visibilityRays points for as much area as a voxel's face has that probe for open space.
    VoxelBuilder(std::unique_ptr<VoxelizeMethod> method, uint32_t visibilityRays)
        : method_(std::move(method)), visibilityRays_(visibilityRays) {}

    /// Reserves what `voxels` take, whose grid and number are known.
    static void planVoxels(PassPlan& plan, const SurfaceVoxels& voxels);
    /// Reserves what making them takes for a while.
    /// @param updates whether update() will be called.
    void planWork(PassPlan& plan, const SurfaceVoxels& voxels, bool updates);
    void prepare(PassSetup& setup);

    /// All that the grid holds.
    void build(PassContext& context, SurfaceVoxels& voxels);
    /// Makes a region of them anew and joins it with what was made before, bit for bit as if all had been
    /// made anew. @return the region's voxels alone, numbered by themselves.
    SurfaceVoxels update(PassContext& context, const VoxelRegion& region, SurfaceVoxels& voxels);

 private:
    /// The voxels of a region, into `target`, whose grid is set. `previous`: all that the grid held before,
    /// where the region is a part of it.
    void voxelize(PassContext& context, const VoxelRegion& region, SurfaceVoxels& target,
                  const SurfaceVoxels* previous);

    std::unique_ptr<VoxelizeMethod> method_;
    uint32_t visibilityRays_;
    Program resolve_;
    std::optional<PopulationPrefixSum> prefixSum_;
    VisibilityProbe visibilityProbe_;
    RegionMerge join_;
    float largestEmission_ = 0;
};

}  // namespace voxray
