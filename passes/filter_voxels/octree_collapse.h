#pragma once

#include "passes/common/prefix_sum.h"
#include "passes/filter_voxels/octree.h"

namespace voxray {

/// Replaces uniform parts of an octree by one value each: where all eight children of a node hold the same
/// bits, the node stands for them, and so on upwards (Crassin 2011; Arnebäck 2017, section 5.4 and figure
/// 48). Exact: samples stay as they are.
class OctreeCollapse {
 public:
    OctreeCollapse(Device& device, const ShaderCompiler& compiler);

    /// The octree as it is where nothing is uniform; else a smaller one. Waits for the device.
    RadianceOctree run(CommandStream& stream, RadianceOctree octree) const;

 private:
    RadianceOctree shrink(CommandStream& stream, const RadianceOctree& octree, const Buffer& uniform,
                          OctreeSize size) const;

    Program uniform_, masks_, children_, table_;
    PopulationPrefixSum prefixSum_;
};

}  // namespace voxray
