#include "passes/clusters/cluster_voxels/fragment_angles.h"

#include <algorithm>
#include <numbers>

#include "passes/common/compute/uints.h"

namespace voxray {
namespace {

constexpr float kFinestUnits = 65536;  // Of a radian.

/// A triangle is one fragment of a voxel at most, so that sums of angles up to pi fit into 32 bits.
float unitsFor(size_t triangles) {
    const float most = 0x1p31f / (std::numbers::pi_v<float> * float(std::max<size_t>(triangles, 1)));
    return std::min(most, kFinestUnits);
}

}  // namespace

FragmentAngles::FragmentAngles(ProgramOwner& owner)
    : walk_(makeExactWalk()), add_(walk_->makeVisitor(owner, "passes/clusters/cluster_voxels/add_angles")) {}

FragmentAngles::Sums FragmentAngles::measure(PassContext& context, const SurfaceVoxels& voxels) {
    const Geometry& geometry = context.frame.scene->geometry;
    Sums sums{Buffer(context.device, "angles of fragments", uints(4 * uint64_t(voxels.voxelCount))),
              unitsFor(geometry.triangles.size())};
    context.stream.fill(sums.angles, 0);
    const VoxelRegion region(voxels.grid);
    walk_->select(context, voxels.grid, region, region.triangles(geometry));
    walk_->run(context, *add_, voxels.grid, voxels.bindings({{"fragmentAngles", sums.angles}}),
               sums.unitsPerRadian);
    context.stream.finish();
    walk_->release();
    return sums;
}

}  // namespace voxray
