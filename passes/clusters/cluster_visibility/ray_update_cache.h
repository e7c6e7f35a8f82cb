#pragma once

#include <vector>

#include "graph/pass.h"
#include "passes/clusters/voxel_clusters.h"
#include "passes/clusters/voxel_patches.h"
#include "passes/common/voxel_builder/region_merge.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {

/// The hits of all rays from patches, kept for the next update of a scene in which surfaces move: rays that
/// no change affects are not traced again.
///
///     begin()                before an update; clear() before a build from nothing
///     addChunk(), reuse()    for each chunk of patches: makes the buffer of its hits, fills in those that
///     hold store()                after each build
class RayUpdateCache {
 public:
    explicit RayUpdateCache(ProgramOwner& owner);

    /// Maps `patches` to those of the last build. @param changed where surfaces have changed, m. Waits for
    /// the device.
    void begin(CommandStream& stream, const SurfaceVoxels& voxels, const VoxelClusters& clusters,
               const VoxelPatches& patches, const std::vector<Box>& changed);
    bool isActive() const { return isActive_; }
    /// Writes those of `count` hits that still hold, and flags the other rays (reuse_hits.comp). @param rays
    /// its other bindings.
    void reuse(CommandStream& stream, const Bindings& rays, uint32_t count) const;
    /// Makes the buffer of the next chunk's hits.
    const Buffer& addChunk(Device& device, uint64_t rays);
    /// Ends the update, and stores how patches are numbered. Waits for the device.
    void store(CommandStream& stream, const VoxelPatches& patches);
    void clear();

 private:
    Kernel storeFirstPatches_, renumberGroups_, reuseHits_;
    RegionMerge regions_;
    std::vector<Buffer> packedHits_, previousHits_;  ///< By chunk and ray (packed_hit.glsl).
    Buffer firstPatches_;                            ///< By group.
    uint32_t groupCount_ = 0;
    Buffer previousHitAddresses_, newGroups_, previousFirstPatches_, boxes_;  ///< For an update.
    bool isActive_ = false;
};

}  // namespace voxray
