#pragma once

#include "passes/common/compute/prefix_sum.h"
#include "passes/common/octree/octree.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {

/// Builds the structure of a sparse octree over surface voxels (Crassin et al. 2011; Arnebäck 2017, section
/// 3.2.2): flags and counts the nonempty voxels of each level, allocates, then subdivides and numbers nodes
/// level by level from the root. Deterministic: a node's index depends on the voxels only.
class OctreeBuilder {
 public:
    explicit OctreeBuilder(ProgramOwner& owner);

    /// The octree over `voxels` of a whole grid, with `leafVoxels`. Waits for the device.
    Octree build(CommandStream& stream, const SurfaceVoxels& voxels) const;

 private:
    /// Flags the nonempty voxels of each level above the leaves, a bit each. Sets size.nodes.
    std::vector<Buffer> flag(CommandStream& stream, const SurfaceVoxels& voxels, OctreeSize& size) const;

    Kernel flag_, subdivide_, number_;
    PrefixSum prefixSum_;
};

}  // namespace voxray
