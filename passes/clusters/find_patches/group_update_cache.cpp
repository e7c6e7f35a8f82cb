#include "passes/clusters/find_patches/group_update_cache.h"

#include <algorithm>
#include <utility>

#include "passes/clusters/find_patches/stored_group.h"
#include "passes/common/compute/uint_bytes.h"
#include "passes/common/voxel_builder/changed_voxels.h"

namespace voxray {

GroupUpdateCache::GroupUpdateCache(ProgramOwner& owner)
    : storeSurfelGroups_(owner, "store_surfel_groups.comp"),
      findPreviousGroups_(owner, "find_previous_groups.comp"),
      regions_(owner) {}

void GroupUpdateCache::startUpdate(CommandStream& stream, const SurfaceVoxels& voxels, VoxelPatches& patches,
                                   const std::vector<Box>& changed) {
    const auto changedBits = [&](uint32_t margin) {
        return regions_.bits(stream, VoxelRegion(voxels.grid, changedVoxels(voxels.grid, changed, margin)), voxels);
    };
    changed_ = changedBits(0);
    changedNeighborhood_ = changedBits(1);
    firstGroup_ = std::move(patches.firstGroup);
    firstNeighbor_ = std::move(patches.firstNeighbor);
    neighbors_ = std::move(patches.neighbors);
    isActive_ = true;
}

std::vector<Binding> GroupUpdateCache::surfelBindings(const VoxelClusters& clusters) const {
    return {{"coordinates", clusters.coordinates}, {"changed", changed_}, {"StoredGroupsRef", storedGroups_.ref()}};
}

void GroupUpdateCache::findPreviousGroupIndices(CommandStream& stream, const SurfaceVoxels& voxels,
                                                const VoxelClusters& clusters, VoxelPatches& patches) {
    patches.previousGroupIndex = Buffer(stream.device(), "previous groups", uintBytes(patches.groupCount));
    reusablePreviousIndex_ =
        Buffer(stream.device(), "groups whose neighbors are reused", uintBytes(patches.groupCount));
    stream.dispatch(findPreviousGroups_, patches.groupCount,
                    {{"groups", patches.groups},
                     {"firstGroup", patches.firstGroup},
                     {"coordinates", clusters.coordinates},
                     {"changed", changed_},
                     {"changedNeighborhood", changedNeighborhood_},
                     {"previousOccupancy", occupancy_},
                     {"previousRank", rank_},
                     {"previousFirstGroup", firstGroup_},
                     {"previousGroupIndex", patches.previousGroupIndex},
                     {"reusablePreviousIndex", reusablePreviousIndex_},
                     {"grid", voxels.grid},
                     {"groupCount", patches.groupCount}});
}

std::vector<Binding> GroupUpdateCache::neighborRayBindings() const {
    return {{"reusablePreviousIndex", reusablePreviousIndex_}};
}

std::vector<Binding> GroupUpdateCache::previousNeighborBindings(const VoxelClusters& clusters,
                                                                const VoxelPatches& patches) const {
    return {{"reusablePreviousIndex", reusablePreviousIndex_},
            {"coordinates", clusters.coordinates},
            {"groups", patches.groups},
            {"firstGroup", patches.firstGroup},
            {"previousFirstNeighbor", firstNeighbor_},
            {"PreviousNeighborsRef", neighbors_.ref()}};
}

void GroupUpdateCache::finishUpdate() {
    changed_ = {}, changedNeighborhood_ = {}, reusablePreviousIndex_ = {}, firstGroup_ = {}, firstNeighbor_ = {},
    neighbors_ = {};
    isActive_ = false;
}

void GroupUpdateCache::storeSurfels(CommandStream& stream, const LargeBuffer& surfels, uint32_t count,
                                    uint64_t idCount) {
    ensureSize(storedGroups_, stream.device(), "groups of surfels",
               std::max<uint64_t>(idCount, 1) * sizeof(gpu::StoredGroup));
    stream.dispatch(
        storeSurfelGroups_, count,
        {{"GroupedSurfelsRef", surfels.ref()}, {"StoredGroupsRef", storedGroups_.ref()}, {"surfels", count}});
}

void GroupUpdateCache::storeVoxels(CommandStream& stream, const SurfaceVoxels& voxels) {
    ensureSize(occupancy_, stream.device(), "previous occupancy", voxels.occupancy.bytes());
    ensureSize(rank_, stream.device(), "previous ranks", voxels.rank.bytes());
    stream.copy(voxels.occupancy, occupancy_, voxels.occupancy.bytes());
    stream.copy(voxels.rank, rank_, voxels.rank.bytes());
    stream.finish();
}

}  // namespace voxray
