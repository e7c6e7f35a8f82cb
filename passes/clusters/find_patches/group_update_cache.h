#pragma once

#include <vector>

#include "graph/pass.h"
#include "passes/clusters/voxel_clusters.h"
#include "passes/clusters/voxel_patches.h"
#include "passes/common/voxel_builder/region_merge.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {

/// Surface groups of the last build, for updates of a scene in which surfaces move: groups of unchanged
/// voxels are reused, and so is the occlusion between neighbours where nothing near them has changed.
///
///     begin()                        before an update, while the last build's groups are there
///     surfelBindings()               the group that each surfel was in (init_surfels.comp)
///     findPrevious()                 once groups are numbered
///     neighbourRayBindings()         which groups need no rays to neighbours (generate_neighbour_rays.comp)
///     previousNeighbourBindings()    their neighbours (remove_occluded_neighbours.comp)
///     end()
///     store...()                     in each build
class GroupUpdateCache {
 public:
    explicit GroupUpdateCache(ProgramOwner& owner);

    /// Moves buffers out of `patches`. @param changed where surfaces have changed, m. Waits for the
    /// device.
    void begin(CommandStream& stream, const SurfaceVoxels& voxels, VoxelPatches& patches,
               const std::vector<Box>& changed);
    bool isActive() const { return isActive_; }
    std::vector<Binding> surfelBindings(const VoxelClusters& clusters) const;
    /// Fills VoxelPatches::previousGroups.
    void findPrevious(CommandStream& stream, const SurfaceVoxels& voxels, const VoxelClusters& clusters,
                      VoxelPatches& patches);
    std::vector<Binding> neighbourRayBindings() const;
    std::vector<Binding> previousNeighbourBindings(const VoxelPatches& patches) const;
    /// Frees what begin() took. The stream has finished.
    void end();

    /// Call before groups are numbered. @param idCount of surfels: ids are below. The stream has finished.
    void storeSurfels(CommandStream& stream, const VoxelPatches& patches, uint64_t idCount);
    void storeVoxels(CommandStream& stream, const SurfaceVoxels& voxels);

 private:
    Kernel storeSurfelGroups_, findPreviousGroups_;
    RegionMerge regions_;
    Buffer occupancy_, rank_;             ///< Of the last build.
    LargeBuffer storedGroups_;            ///< gpu::StoredGroup by surfel id.
    Buffer changed_, nearChange_;         ///< For an update: a bit a voxel.
    Buffer reusedGroup_;                  ///< By group: its previous number where its neighbours are reused.
    Buffer firstGroup_, firstNeighbour_;  ///< Of the last build.
    LargeBuffer neighbours_;
    bool isActive_ = false;
};

}  // namespace voxray
