#pragma once

#include "passes/clusters/voxel_clusters.h"
#include "passes/clusters/voxel_patches.h"
#include "passes/common/compute/compaction.h"
#include "passes/common/compute/histogram.h"
#include "passes/common/compute/radix_sort.h"

namespace voxray {

/// Candidates for neighbors of surface groups; NO_GROUP: occluded.
struct NeighborCandidates {
    uint32_t count = 0;
    Buffer first;        ///< First candidate of each group; then the number of candidates.
    LargeBuffer groups;  ///< Index of each candidate.
};

/// Finds the components of each cluster, its connected surface groups, by label propagation.
class ComponentLabeling {
 public:
    explicit ComponentLabeling(ProgramOwner& owner);

    /// Fills the components of `patches`, whose groups are given. Waits for the device.
    void run(CommandStream& stream, const VoxelClusters& clusters, const NeighborCandidates& candidates,
             VoxelPatches& patches);

 private:
    /// Fills VoxelPatches::components once the groups are sorted by component.
    void listComponents(CommandStream& stream, VoxelPatches& patches);

    PrefixSum prefixSum_;
    Compaction compaction_;
    Histogram histogram_;
    RadixSort radixSort_;
    Kernel iota_, propagateLabels_, flagRoots_, numberComponents_, assignComponents_, initComponents_, numberFaces_;
};

}  // namespace voxray
