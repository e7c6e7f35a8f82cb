#pragma once

#include <memory>
#include <string>
#include <tuple>

#include "passes/common/compute/prefix_sum.h"
#include "passes/common/triangle_voxelizer/triangle_voxelizer.h"
#include "passes/common/voxel_builder/changed_voxels.h"
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
                  "6: a voxel has light of its own for each of its six faces. "
                  "1: one value for all of a voxel, so that light from both sides of a thin wall mixes.",
                  {1, 6}),
            field("visibility_rays", &VoxelBuildParams::visibilityRays,
                  "Visibility probes on a surface as large as a voxel's face: "
                  "points that look for open space in front of the surface and behind it. "
                  "0: all surfaces count as visible from both sides, which darkens thin closed walls.",
                  0u, 256u)};
    }
};

/// Builds surface voxels from triangles, in two voxelizations: the first marks the voxels that triangles
/// meet, the second, once marked voxels are numbered, accumulates the materials of their surfaces, weighted
/// by area. Sums are integers: the result does not depend on the order of additions.
class VoxelBuilder {
 public:
    /// @param visibilityRays visibility probes for as much area as a voxel's face has.
    VoxelBuilder(ProgramOwner& owner, std::unique_ptr<TriangleVoxelizer> voxelizer, uint32_t visibilityRays);

    /// Describes the memory of `voxels` that their grid tells.
    static void planVoxels(PassPlan& plan, SurfaceVoxels& voxels);
    /// Describes what building them takes. @throws Error naming a feature that the device lacks.
    void planWork(PassPlan& plan);

    /// Builds all voxels that the grid holds.
    void build(PassContext& context, SurfaceVoxels& voxels);
    /// Builds a region of them again and merges it into the others, bit for bit as if all had been built
    /// again. @return the region's voxels alone, numbered by themselves.
    SurfaceVoxels update(PassContext& context, const VoxelRegion& region, SurfaceVoxels& voxels);

 private:
    /// Builds the voxels of a region into `target`, whose grid is set. `previous`: all voxels of the last
    /// build, where the region is a part of the grid.
    void voxelize(PassContext& context, const VoxelRegion& region, SurfaceVoxels& target,
                  const SurfaceVoxels* previous);

    std::unique_ptr<TriangleVoxelizer> voxelizer_;
    const uint32_t visibilityRays_;
    std::unique_ptr<PassProgram> markVoxels_, addSurfaces_;
    Kernel resolve_;
    PrefixSum prefixSum_;
    VisibilityProbe visibilityProbe_;
    RegionMerge merge_;
    float largestEmission_ = 0;
};

}  // namespace voxray
