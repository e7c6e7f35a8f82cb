#pragma once

#include "passes/common/compute/prefix_sum.h"
#include "passes/common/octree/brick_octree.h"

namespace voxray {

/// Builds the octree of Arnebäck 2017 on the device, from the root down (section 3.2.2, after Crassin and
/// Green 2012): flag the nodes of a level that fragments fall into, and the 26 round each; link neighbours;
/// subdivide. A node's number depends on the voxels of the fragments alone, not on their order.
class BrickOctreeBuilder {
 public:
    /// @param neighbors whether the 26 are made to exist.
    BrickOctreeBuilder(ProgramOwner& owner, bool neighbors);

    /// Builds the static section in place of all that was there. Waits for the device once a level.
    /// @param cells a uint for each fragment: its voxel, 10 bits an axis. More than one may be in a voxel.
    /// The pool grows level by level.
    void build(CommandStream& stream, BrickOctree& octree, const LargeBuffer& cells,
               uint32_t fragments) const;
    /// Builds the dynamic section in place of the one that was there. Likewise.
    void rebuildDynamic(CommandStream& stream, BrickOctree& octree, const LargeBuffer& cells,
                        uint32_t fragments) const;

 private:
    enum class Section { Static, Dynamic };
    void addNodes(CommandStream& stream, BrickOctree& octree, Section section, const LargeBuffer& cells,
                  uint32_t fragments) const;

    uint32_t neighbors_;
    Kernel flag_, link_, subdivide_, clear_;
    PrefixSum prefixSum_;
};

}  // namespace voxray
