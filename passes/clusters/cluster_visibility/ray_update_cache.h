#pragma once

#include <vector>

#include "graph/pass.h"
#include "passes/clusters/voxel_clusters.h"
#include "passes/clusters/voxel_patches.h"
#include "passes/common/voxel_builder/region_merge.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {

/// Stores the hits of all rays from patches for the next update of a scene with moving surfaces: rays that no
/// change affects are not traced again.
///
///     startUpdate()    before an update; clear() before a build from scratch
///     addChunk()       for each chunk of patches: makes the buffer of its hits
///     reuse()          for each chunk of an update: copies the hits that are still valid
///     store()          after each build
class RayUpdateCache {
 public:
    explicit RayUpdateCache(ProgramOwner& owner);

    /// Maps `patches` to those of the previous build. @param changed boxes in which surfaces have changed, m.
    /// Waits for the device.
    void startUpdate(CommandStream& stream, const SurfaceVoxels& voxels, const VoxelClusters& clusters,
                     const VoxelPatches& patches, const std::vector<Box>& changed);
    bool isActive() const { return isActive_; }
    /// Writes the hits of `count` rays that are still valid and flags the other rays (reuse_hits.comp).
    /// @param rays the other bindings of that shader.
    void reuse(CommandStream& stream, const Bindings& rays, uint32_t count) const;
    /// Makes the buffer of the next chunk's hits.
    const Buffer& addChunk(Device& device, uint64_t rays);
    /// Ends the update and stores the indices of patches. Waits for the device.
    void store(CommandStream& stream, const VoxelPatches& patches);
    void clear();

 private:
    Kernel storeFirstPatches_, renumberGroups_, reuseHits_;
    RegionMerge regions_;
    std::vector<Buffer> packedHits_, previousHits_;  ///< Per chunk (packed_hit.glsl).
    Buffer firstPatches_;                            ///< Per group.
    uint32_t groupCount_ = 0;
    Buffer previousHitAddresses_, newGroupIndex_, previousFirstPatches_, boxes_;  ///< During an update.
    bool isActive_ = false;
};

}  // namespace voxray
