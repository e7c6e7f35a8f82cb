#include "passes/clusters/find_patches/kept_sides.h"

#include <algorithm>
#include <utility>

#include "passes/clusters/find_patches/saved_side.h"
#include "passes/common/compute/uints.h"
#include "passes/common/voxel_builder/changed_voxels.h"

namespace voxray {

KeptSides::KeptSides(ProgramOwner& owner)
    : save_(owner, "save.comp"), previous_(owner, "previous.comp"), regions_(owner) {}

void KeptSides::begin(CommandStream& stream, const SurfaceVoxels& voxels, VoxelPatches& patches,
                      const std::vector<Box>& changed) {
    const auto bits = [&](uint32_t more) {
        return regions_.bits(stream, VoxelRegion(voxels.grid, changedVoxels(voxels.grid, changed, more)),
                             voxels);
    };
    changed_ = bits(0);
    near_ = bits(1);
    firstSide_ = std::move(patches.firstSide);
    firstNeighbour_ = std::move(patches.firstNeighbour);
    neighbours_ = std::move(patches.neighbours);
    isActive_ = true;
}

std::vector<Binding> KeptSides::surfelBindings(const VoxelClusters& clusters) const {
    return {{"coordinates", clusters.coordinates}, {"changed", changed_}, {"SavedSidesAt", saved_.at()}};
}

void KeptSides::findPrevious(CommandStream& stream, const SurfaceVoxels& voxels,
                             const VoxelClusters& clusters, VoxelPatches& patches) {
    patches.previousSides = Buffer(stream.device(), "previous sides", uints(patches.sideCount));
    pairsFrom_ = Buffer(stream.device(), "sides whose pairs are known", uints(patches.sideCount));
    stream.dispatch(previous_, patches.sideCount,
                    {{"sides", patches.sides},
                     {"firstSide", patches.firstSide},
                     {"coordinates", clusters.coordinates},
                     {"changed", changed_},
                     {"near", near_},
                     {"occupancyBefore", occupancy_},
                     {"rankBefore", rank_},
                     {"firstSideBefore", firstSide_},
                     {"previousSides", patches.previousSides},
                     {"pairsFrom", pairsFrom_},
                     {"grid", voxels.grid},
                     {"sideCount", patches.sideCount}});
}

std::vector<Binding> KeptSides::pairBindings() const {
    return {{"pairsFrom", pairsFrom_}};
}

std::vector<Binding> KeptSides::hiddenBindings(const VoxelPatches& patches) const {
    return {{"pairsFrom", pairsFrom_},
            {"firstNeighbour", patches.firstNeighbour},
            {"firstNeighbourBefore", firstNeighbour_},
            {"NeighboursBeforeAt", neighbours_.at()}};
}

void KeptSides::end() {
    changed_ = {}, near_ = {}, pairsFrom_ = {}, firstSide_ = {}, firstNeighbour_ = {}, neighbours_ = {};
    isActive_ = false;
}

void KeptSides::rememberSurfels(CommandStream& stream, const VoxelPatches& patches, uint64_t ids) {
    makeOrKeep(saved_, stream.device(), "sides of surfels",
               std::max<uint64_t>(ids, 1) * sizeof(gpu::SavedSide));
    stream.dispatch(save_, patches.surfelCount,
                    {{"PatchSurfelsAt", patches.surfels.at()},
                     {"SavedSidesAt", saved_.at()},
                     {"surfels", patches.surfelCount}});
}

void KeptSides::rememberVoxels(CommandStream& stream, const SurfaceVoxels& voxels) {
    makeOrKeep(occupancy_, stream.device(), "occupancy before", voxels.occupancy.bytes());
    makeOrKeep(rank_, stream.device(), "ranks before", voxels.rank.bytes());
    stream.copy(voxels.occupancy, occupancy_, voxels.occupancy.bytes());
    stream.copy(voxels.rank, rank_, voxels.rank.bytes());
    stream.finish();
}

}  // namespace voxray
