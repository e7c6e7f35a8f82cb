#pragma once

#include "passes/common/compute/prefix_sum.h"
#include "passes/cones/filter_voxels/svo_values.h"

namespace voxray {

/// Collapses uniform subtrees of an octree, bottom-up: a node replaces its eight children if they have the
/// same bits (Crassin 2011; Arnebäck 2017, section 5.4 and figure 48). Exact: samples don't change.
class SvoCollapse {
 public:
    explicit SvoCollapse(ProgramOwner& owner);

    /// Replaces the octree of `radiance` by a collapsed one if any node is uniform. Waits for the device.
    void run(CommandStream& stream, RadianceVoxels& radiance) const;

 private:
    RadianceVoxels shrink(CommandStream& stream, const RadianceVoxels& radiance, const Buffer& uniform,
                          const OctreeSize& smaller) const;

    Kernel markUniform_, copyMasks_, copyNodes_, fillTable_;
    PrefixSum prefixSum_;
};

}  // namespace voxray
