#pragma once

#include <functional>
#include <memory>
#include <string>
#include <tuple>

#include "passes/common/compute/prefix_sum.h"
#include "passes/common/triangle_voxelizer/triangle_voxelizer.h"
#include "passes/common/voxel_builder/changed_voxels.h"
#include "passes/common/voxel_builder/region_merge.h"
#include "passes/common/voxel_builder/visibility_probe.h"
#include "passes/common/voxels/keep_children.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {

/// Parameters of a pass that voxelizes; it adds schema() to its own with std::tuple_cat.
struct VoxelBuildParams {
    uint32_t directions = 6;
    uint32_t visibilityRays = 8;
    static constexpr auto schema() {
        return std::tuple{field("directions", &VoxelBuildParams::directions,
                                "6: light is stored for each face of a voxel. "
                                "1: all faces share one value, so that light from both sides of a thin wall mixes.",
                                {1, 6}),
                          field("visibility_rays", &VoxelBuildParams::visibilityRays,
                                "Visibility probes per area of a voxel's face: "
                                "points whose two sides are tested for occlusion within a voxel's width. "
                                "0: all surfaces count as visible from both sides, which darkens thin closed walls.",
                                0u, 256u)};
    }
};

/// Builds surface voxels from triangles in two voxelizations: the first marks occupied voxels; the second,
/// after these are numbered, accumulates the materials of their surfaces, weighted by area. Sums are
/// integers: the result does not depend on the order of additions.
class VoxelBuilder {
 public:
    /// @param visibilityRays visibility probes per area of a voxel's face.
    VoxelBuilder(ProgramOwner& owner, std::unique_ptr<TriangleVoxelizer> voxelizer, uint32_t visibilityRays);

    /// Describes the occupancy and ranks of `voxels`, whose grid is set.
    static void planVoxels(PassPlan& plan, SurfaceVoxels& voxels);
    /// Describes scratch memory. @throws Error naming a feature that the device lacks.
    void planWork(PassPlan& plan);

    /// Builds all voxels of the grid's window.
    void build(PassContext& context, SurfaceVoxels& voxels);
    /// Builds those voxels alone that lie in voxels twice as wide. @param parents bits of these, as KeepChildren has
    /// them, of `parentGrid`.
    void buildWithin(PassContext& context, const gpu::VoxelGrid& parentGrid, const Buffer& parents,
                     SurfaceVoxels& voxels);
    /// Rebuilds a region and merges it into the other voxels; bit-identical to build(). @return the region's
    /// voxels only, with their own numbers.
    SurfaceVoxels update(PassContext& context, const VoxelRegion& region, SurfaceVoxels& voxels);

 private:
    /// Builds the voxels of a region into `target`, whose grid is set. @param restrict changes which voxels are
    /// occupied, once all are marked.
    void voxelize(PassContext& context, const VoxelRegion& region, SurfaceVoxels& target,
                  const std::function<void()>& restrict);

    std::unique_ptr<TriangleVoxelizer> voxelizer_;
    const uint32_t visibilityRays_;
    std::unique_ptr<PassProgram> markVoxels_, addSurfaces_;
    Kernel resolve_;
    PrefixSum prefixSum_;
    VisibilityProbe visibilityProbe_;
    RegionMerge merge_;
    KeepChildren keepChildren_;
    float largestEmission_ = 0;
};

}  // namespace voxray
