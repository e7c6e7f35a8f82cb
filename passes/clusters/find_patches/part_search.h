#pragma once

#include "passes/clusters/voxel_clusters.h"
#include "passes/clusters/voxel_patches.h"
#include "passes/common/compute/compaction.h"
#include "passes/common/compute/histogram.h"
#include "passes/common/compute/radix_sort.h"

namespace voxray {

/// Splits clusters into parts: sides of their voxels that hang together by neighbours.
class PartSearch {
 public:
    explicit PartSearch(ProgramOwner& owner);

    /// Fills the parts of patches whose sides and neighbours are known. Waits for the device.
    void find(CommandStream& stream, const VoxelClusters& clusters, VoxelPatches& patches);

 private:
    PrefixSum prefixSum_;
    Compaction compaction_;
    Histogram histogram_;
    RadixSort radixSort_;
    Kernel label_, spread_, flag_, number_, assign_, parts_;
};

}  // namespace voxray
