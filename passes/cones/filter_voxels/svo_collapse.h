#pragma once

#include "passes/common/compute/prefix_sum.h"
#include "passes/cones/filter_voxels/svo_values.h"

namespace voxray {

/// Replaces uniform parts of an octree by one value each: where all eight children of a node hold the same
/// bits, the node stands for them, and so on upwards (Crassin 2011; Arnebäck 2017, section 5.4 and figure
/// 48). Exact: samples stay as they are.
class SvoCollapse {
 public:
    explicit SvoCollapse(ProgramOwner& owner);

    /// Puts a smaller octree into `radiance`, and leaves it as it is where nothing is uniform. Waits for the
    /// device.
    void run(CommandStream& stream, RadianceVoxels& radiance) const;

 private:
    RadianceVoxels shrink(CommandStream& stream, const RadianceVoxels& radiance, const Buffer& uniform,
                          const OctreeSize& smaller) const;

    Kernel uniform_, masks_, words_, table_;
    PrefixSum prefixSum_;
};

}  // namespace voxray
