#pragma once

#include "passes/common/compute/bit_words.h"
#include "passes/common/octree/octree.h"
#include "passes/cones/radiance/radiance_voxels.h"

namespace voxray {

/// Moves an octree into `radiance`, whose grid is set, and allocates undefined values for its nodes: 64 bits
/// by direction and node (passes/cones/radiance/radiance_texel.glsl).
void allocateSvoValues(CommandStream& stream, Octree octree, RadianceVoxels& radiance);

/// Filters the values of inner nodes from those of their children, bottom-up.
class SvoFilter {
 public:
    explicit SvoFilter(ProgramOwner& owner);

    /// Filters the nodes whose children have changed. `changed`: a bit per node (changedBytes()), set for
    /// leaves with new values, or for all nodes; set for the nodes that get new values, too.
    void run(CommandStream& stream, const RadianceVoxels& radiance, const Buffer& changed) const;
    static uint64_t changedBytes(const OctreeSize& size) { return bitWords(size.nodeCount()) * sizeof(uint32_t); }

 private:
    Kernel filter_;
};

}  // namespace voxray
