#pragma once

#include "passes/common/compute/prefix_sum.h"
#include "passes/common/octree/brick_octree.h"

namespace voxray {

/// Builds the octree of Arnebäck 2017 on the device, top-down (section 3.2.2, after Crassin and Green 2012):
/// in each level flag the nodes that hold fragments, and their 26 neighbors; link neighbors; subdivide. A
/// node's index depends on the voxels of the fragments alone, not on their order.
class BrickOctreeBuilder {
 public:
    /// @param neighbors whether the 26 neighbors get bricks as well.
    BrickOctreeBuilder(ProgramOwner& owner, bool neighbors);

    /// Replaces the whole octree by a static section. Waits for the device once per level.
    /// @param cells a uint for each fragment: the coordinates of its voxel, 10 bits each. Voxels may have
    /// several fragments.
    void build(CommandStream& stream, BrickOctree& octree, const LargeBuffer& cells, uint32_t fragments) const;
    /// Replaces the dynamic section. Parameters as in build().
    void rebuildDynamic(CommandStream& stream, BrickOctree& octree, const LargeBuffer& cells, uint32_t fragments) const;

 private:
    enum class Section { Static, Dynamic };
    void addNodes(CommandStream& stream, BrickOctree& octree, Section section, const LargeBuffer& cells,
                  uint32_t fragments) const;

    uint32_t neighbors_;
    Kernel flag_, link_, subdivide_, clear_;
    PrefixSum prefixSum_;
};

}  // namespace voxray
