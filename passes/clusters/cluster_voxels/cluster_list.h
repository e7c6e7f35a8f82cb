#pragma once

#include "passes/clusters/cluster_voxels/slic_clustering.h"
#include "passes/common/compute/compaction.h"
#include "passes/common/compute/histogram.h"

namespace voxray {

/// Removes empty clusters and assigns consecutive indices to the others.
class ClusterList {
 public:
    explicit ClusterList(ProgramOwner& owner);

    /// Sets all members of `clusters` except `coordinates`. Waits for the device.
    void build(CommandStream& stream, uint32_t voxelCount, const SlicClustering::Result& slic, VoxelClusters& clusters);

 private:
    Histogram histogram_;
    Compaction compaction_;
    Kernel flagNonempty_, initClusters_, renumberAssignment_;
};

}  // namespace voxray
