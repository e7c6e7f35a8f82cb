#pragma once

#include <vector>

#include "graph/pass.h"
#include "passes/clusters/voxel_clusters.h"
#include "passes/clusters/voxel_patches.h"
#include "passes/common/voxel_builder/region_merge.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {

/// Stores the surface groups of a build for the next update of a scene with moving surfaces: groups of
/// unchanged voxels are reused, and so is the occlusion between neighbors where no adjacent voxel has
/// changed.
///
///     startUpdate()                  before an update, with the previous build's groups
///     surfelBindings()               the previous group of each surfel (init_surfels.comp)
///     findPreviousGroupIndices()     once groups are numbered
///     neighborRayBindings()         groups without rays to neighbors (generate_neighbor_rays.comp)
///     previousNeighborBindings()    their neighbors (remove_occluded_neighbors.comp)
///     finishUpdate()
///     store...()                     in each build
class GroupUpdateCache {
 public:
    explicit GroupUpdateCache(ProgramOwner& owner);

    /// Moves buffers out of `patches`. @param changed boxes with changed surfaces, m. Waits for the device.
    void startUpdate(CommandStream& stream, const SurfaceVoxels& voxels, VoxelPatches& patches,
                     const std::vector<Box>& changed);
    bool isActive() const { return isActive_; }
    std::vector<Binding> surfelBindings(const VoxelClusters& clusters) const;
    /// Fills VoxelPatches::previousGroupIndex.
    void findPreviousGroupIndices(CommandStream& stream, const SurfaceVoxels& voxels, const VoxelClusters& clusters,
                                  VoxelPatches& patches);
    std::vector<Binding> neighborRayBindings() const;
    std::vector<Binding> previousNeighborBindings(const VoxelClusters& clusters, const VoxelPatches& patches) const;
    /// Frees what startUpdate() moved. The stream must have finished.
    void finishUpdate();

    /// Call before groups are numbered, after the stream has finished. @param surfels gpu::GroupedSurfel each.
    /// @param idCount upper bound of ids.
    void storeSurfels(CommandStream& stream, const LargeBuffer& surfels, uint32_t count, uint64_t idCount);
    void storeVoxels(CommandStream& stream, const SurfaceVoxels& voxels);

 private:
    Kernel storeSurfelGroups_, findPreviousGroups_;
    RegionMerge regions_;
    Buffer occupancy_, rank_;               ///< From the previous build.
    LargeBuffer storedGroups_;              ///< gpu::StoredGroup of each surfel id.
    Buffer changed_, changedNeighborhood_;  ///< During an update: a bit for each voxel.
    Buffer reusablePreviousIndex_;          ///< Per group, see find_previous_groups.comp.
    Buffer firstGroup_, firstNeighbor_;     ///< From the previous build.
    LargeBuffer neighbors_;                 ///< Likewise.
    bool isActive_ = false;
};

}  // namespace voxray
