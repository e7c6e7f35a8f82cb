#pragma once

#include "passes/clusters/cluster_voxels/cluster_growth.h"
#include "passes/common/compute/compaction.h"
#include "passes/common/compute/histogram.h"
#include "passes/common/compute/radix_sort.h"

namespace voxray {

/// Drops empty clusters, lists the voxels of each and describes it.
class ClusterList {
 public:
    explicit ClusterList(ProgramOwner& owner);

    /// Fills `clusters`, whose coordinates are there. Waits for the device.
    void make(CommandStream& stream, const SurfaceVoxels& voxels, const ClusterGrowth::Result& growth,
              VoxelClusters& clusters);

 private:
    Histogram histogram_;
    PrefixSum prefixSum_;
    Compaction compaction_;
    RadixSort sort_;
    Kernel occupied_, begin_, renumber_, describe_;
};

}  // namespace voxray
