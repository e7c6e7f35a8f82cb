#include "passes/clusters/cluster_voxels/fragment_angle_sums.h"

#include <algorithm>
#include <numbers>

#include "passes/common/compute/uint_bytes.h"

namespace voxray {
namespace {

constexpr float kMaxAngleScale = 65536;

/// The fixed-point scale with which a sum of angles up to pi, one for each triangle, fits into 32 bits.
float angleScale(size_t triangles) {
    const float limit = 0x1p31f / (std::numbers::pi_v<float> * float(std::max<size_t>(triangles, 1)));
    return std::min(limit, kMaxAngleScale);
}

}  // namespace

FragmentAngleSums::FragmentAngleSums(ProgramOwner& owner)
    : voxelizer_(makeExactVoxelizer()),
      accumulate_(voxelizer_->makeProgram(owner, "passes/clusters/cluster_voxels/accumulate_angles")) {}

FragmentAngleSums::Sums FragmentAngleSums::measure(PassContext& context, const SurfaceVoxels& voxels) {
    const Geometry& geometry = context.frame.scene->geometry;
    Sums sums{Buffer(context.device, "angles of fragments", uintBytes(4 * uint64_t(voxels.voxelCount))),
              angleScale(geometry.triangles.size())};
    context.stream.fill(sums.angles, 0);
    const VoxelRegion region(voxels.grid);
    voxelizer_->select(context, voxels.grid, region, region.triangles(geometry));
    voxelizer_->run(context, *accumulate_, voxels.grid, voxels.bindings({{"fragmentAngleSums", sums.angles}}),
                    sums.fixedPointScale);
    context.stream.finish();
    voxelizer_->release();
    return sums;
}

}  // namespace voxray
