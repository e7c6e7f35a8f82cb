#pragma once

#include "passes/common/compute/prefix_sum.h"
#include "passes/common/octree/octree.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {

/// Builds the structure of a sparse octree over surface voxels, from the root down (Crassin et al. 2011;
/// Arnebäck 2017, section 3.2.2): flag the voxels of each level that are not empty, count them, allocate,
/// then subdivide and number level by level. A node's number depends on its place alone: the same voxels give
/// the same bits.
class OctreeBuilder {
 public:
    explicit OctreeBuilder(ProgramOwner& owner);

    /// The octree over `voxels`, which are held whole, with the list of its leaves. Waits for the device.
    Octree build(CommandStream& stream, const SurfaceVoxels& voxels) const;

 private:
    /// The flags of each level above the leaves; sets size.nodes.
    std::vector<Buffer> flag(CommandStream& stream, const SurfaceVoxels& voxels, OctreeSize& size) const;

    Kernel flag_, subdivide_, number_;
    PrefixSum prefixSum_;
};

}  // namespace voxray
