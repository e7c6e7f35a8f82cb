#include "passes/clusters/cluster_visibility/ray_update_cache.h"

#include "passes/common/compute/changed_boxes.h"
#include "passes/common/compute/uint_bytes.h"
#include "passes/common/voxel_builder/changed_voxels.h"

namespace voxray {
namespace {

/// Distance in voxels up to which a change may affect a hit: the group of a hit lies in the voxel of the hit
/// or an adjacent one, and the choice of the group depends on the voxels adjacent to that.
constexpr uint32_t kHitReach = 2;

}  // namespace

RayUpdateCache::RayUpdateCache(ProgramOwner& owner)
    : storeFirstPatches_(owner, "store_first_patches.comp"),
      renumberGroups_(owner, "renumber_groups.comp"),
      reuseHits_(owner, "reuse_hits.comp"),
      regions_(owner) {}

void RayUpdateCache::startUpdate(CommandStream& stream, const SurfaceVoxels& voxels, const VoxelClusters& clusters,
                                 const VoxelPatches& patches, const std::vector<Box>& changed) {
    Device& device = stream.device();
    const Buffer changedNeighborhood =
        regions_.bits(stream, VoxelRegion(voxels.grid, changedVoxels(voxels.grid, changed, kHitReach)), voxels);
    newGroupIndex_ = Buffer(device, "new numbers of groups", uintBytes(groupCount_));
    previousFirstPatches_ = Buffer(device, "previous first patches of groups", uintBytes(patches.groupCount));
    stream.fill(newGroupIndex_, NO_GROUP);
    stream.dispatch(renumberGroups_, patches.groupCount,
                    {{"groups", patches.groups},
                     {"previousGroupIndex", patches.previousGroupIndex},
                     {"coordinates", clusters.coordinates},
                     {"changedNeighborhood", changedNeighborhood},
                     {"firstPatches", firstPatches_},
                     {"newGroupIndex", newGroupIndex_},
                     {"previousFirstPatches", previousFirstPatches_},
                     {"grid", voxels.grid},
                     {"groupCount", patches.groupCount}});

    previousHits_ = std::move(packedHits_);
    packedHits_.clear();
    std::vector<uint64_t> addresses;
    for (const Buffer& chunk : previousHits_) addresses.push_back(chunk.address());
    if (addresses.empty()) addresses.resize(1);
    previousHitAddresses_ = Buffer(device, "addresses of previous hits", addresses.size() * sizeof(uint64_t));
    stream.upload(previousHitAddresses_, addresses);
    boxes_ = changedBoxes(stream, changed, voxels.grid.voxelSize);
    stream.finish();
    isActive_ = true;
}

void RayUpdateCache::reuse(CommandStream& stream, const Bindings& rays, uint32_t count) const {
    stream.dispatch(reuseHits_, count,
                    {rays.all(),
                     {"boxes", boxes_},
                     {"previousHits", previousHitAddresses_},
                     {"newGroupIndex", newGroupIndex_},
                     {"previousFirstPatches", previousFirstPatches_}});
}

const Buffer& RayUpdateCache::addChunk(Device& device, uint64_t rays) {
    return packedHits_.emplace_back(device, "packed hits", uintBytes(rays));
}

void RayUpdateCache::store(CommandStream& stream, const VoxelPatches& patches) {
    stream.finish();
    isActive_ = false;
    previousHits_.clear();
    previousHitAddresses_ = {}, newGroupIndex_ = {}, previousFirstPatches_ = {}, boxes_ = {}, firstPatches_ = {};
    groupCount_ = patches.groupCount;
    firstPatches_ = Buffer(stream.device(), "first patches of groups", uintBytes(groupCount_));
    stream.dispatch(storeFirstPatches_, groupCount_,
                    {{"groups", patches.groups}, {"firstPatches", firstPatches_}, {"groupCount", groupCount_}});
    stream.finish();
}

void RayUpdateCache::clear() {
    packedHits_.clear();
    firstPatches_ = {};
    groupCount_ = 0;
}

}  // namespace voxray
