#pragma once

#include "passes/clusters/voxel_clusters.h"
#include "passes/clusters/voxel_patches.h"
#include "passes/common/compute/compaction.h"
#include "passes/common/compute/histogram.h"
#include "passes/common/compute/radix_sort.h"

namespace voxray {

/// Finds the components of each cluster, its connected surface groups, by label propagation.
class ComponentLabeling {
 public:
    explicit ComponentLabeling(ProgramOwner& owner);

    /// Fills the components of `patches`, whose groups and neighbors are given. Waits for the device.
    void run(CommandStream& stream, const VoxelClusters& clusters, VoxelPatches& patches);

 private:
    PrefixSum prefixSum_;
    Compaction compaction_;
    Histogram histogram_;
    RadixSort radixSort_;
    Kernel iota_, propagateLabels_, flagRoots_, numberComponents_, assignComponents_, initComponents_;
};

}  // namespace voxray
