#pragma once

#include <vector>

#include "graph/pass.h"
#include "passes/clusters/voxel_clusters.h"
#include "passes/clusters/voxel_patches.h"
#include "passes/common/voxel_builder/region_merge.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {

/// Sides of the last build, for a scene in which surfaces move: those in voxels that have not changed are
/// kept, and so is what hides neighbours from each other where nothing near them has.
///
///     begin()            before an update, as long as the last build's sides are there
///     surfelBindings()   which side each surfel was on (begin.comp)
///     findPrevious()     once sides are numbered
///     pairBindings()     of which pairs it is known whether something hides them (aim_near.comp),
///     hiddenBindings()   and whether it does (part_near.comp)
///     end()
///     remember...()      in each build
class KeptSides {
 public:
    explicit KeptSides(ProgramOwner& owner);

    /// Takes what it needs out of `patches`. @param changed where surfaces have changed, m. Waits for the
    /// device.
    void begin(CommandStream& stream, const SurfaceVoxels& voxels, VoxelPatches& patches,
               const std::vector<Box>& changed);
    bool isActive() const { return isActive_; }
    std::vector<Binding> surfelBindings(const VoxelClusters& clusters) const;
    /// Finds what each side was (VoxelPatches::previousSides).
    void findPrevious(CommandStream& stream, const SurfaceVoxels& voxels, const VoxelClusters& clusters,
                      VoxelPatches& patches);
    std::vector<Binding> pairBindings() const;
    std::vector<Binding> hiddenBindings(const VoxelPatches& patches) const;
    /// Frees what was taken. The stream has finished.
    void end();

    /// Which side of its voxel each surfel is on, before sides are numbered. @param ids of surfels end
    /// before. The stream has finished.
    void rememberSurfels(CommandStream& stream, const VoxelPatches& patches, uint64_t ids);
    void rememberVoxels(CommandStream& stream, const SurfaceVoxels& voxels);

 private:
    Kernel save_, previous_;
    RegionMerge regions_;
    Buffer occupancy_, rank_;            ///< Of the last build.
    LargeBuffer saved_;                  ///< gpu::SavedSide each, by the surfel's id.
    Buffer changed_, near_;              ///< For an update: a bit a voxel.
    Buffer pairsFrom_;                   ///< By side: its previous number, where its pairs are known.
    Buffer firstSide_, firstNeighbour_;  ///< Of the last build's sides.
    LargeBuffer neighbours_;
    bool isActive_ = false;
};

}  // namespace voxray
