#pragma once

#include "passes/clusters/cluster_voxels/slic_clustering.h"
#include "passes/common/compute/compaction.h"
#include "passes/common/compute/histogram.h"
#include "passes/common/compute/radix_sort.h"

namespace voxray {

/// Removes empty clusters, sorts voxels by cluster, and averages over each cluster.
class ClusterList {
 public:
    explicit ClusterList(ProgramOwner& owner);

    /// Fills `clusters`, whose `coordinates` are given. Waits for the device.
    void build(CommandStream& stream, const SurfaceVoxels& voxels, const SlicClustering::Result& slic,
               VoxelClusters& clusters);

 private:
    Histogram histogram_;
    PrefixSum prefixSum_;
    Compaction compaction_;
    RadixSort sort_;
    Kernel flagNonempty_, initClusters_, renumberAssignment_, averageClusters_;
};

}  // namespace voxray
