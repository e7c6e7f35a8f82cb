#pragma once

#include "passes/common/octree/octree.h"
#include "passes/cones/radiance/radiance_voxels.h"

namespace voxray {

/// Radiance of an octree's nodes: RadianceVoxels whose `octree` has the structure, with 64 bits by direction
/// and node in `storage` (passes/cones/radiance/radiance_texel.glsl).

/// Gives `radiance`, whose grid is set, an octree and values for its nodes, which are left undefined.
void allocateSvoValues(CommandStream& stream, Octree octree, RadianceVoxels& radiance);

/// Values of inner nodes from those of their children, from the leaves up.
class SvoFilter {
 public:
    explicit SvoFilter(ProgramOwner& owner);

    /// Filters the nodes whose children have changed. `changed`: a bit a node (changedBytes()), set for
    /// leaves with a new value, or for all nodes; the nodes that get a new value are set.
    void run(CommandStream& stream, const RadianceVoxels& radiance, const Buffer& changed) const;
    static uint64_t changedBytes(const OctreeSize& size) {
        return (uint64_t(size.nodeCount()) + 31) / 32 * sizeof(uint32_t);
    }

 private:
    Kernel filter_;
};

}  // namespace voxray
