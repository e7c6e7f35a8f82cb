#pragma once

#include <vector>

#include "graph/pass.h"
#include "passes/clusters/voxel_clusters.h"
#include "passes/clusters/voxel_patches.h"
#include "passes/common/voxel_builder/region_merge.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {

/// What the rays of all patches met, for a scene in which surfaces move: those that meet no change on their
/// way need not be traced again.
///
///     begin()            before an update; clear() before a build from nothing
///     keep(), add()      for each chunk of patches: what still holds, and what its rays have met now
///     remember()         after each build
class KeptRays {
 public:
    explicit KeptRays(ProgramOwner& owner);

    /// Finds where what rays of `patches` have met is kept. @param changed where surfaces have changed, m.
    /// Waits for the device.
    void begin(CommandStream& stream, const SurfaceVoxels& voxels, const VoxelClusters& clusters,
               const VoxelPatches& patches, const std::vector<Box>& changed);
    bool isActive() const { return isActive_; }
    /// Writes what `count` rays met that still holds, and flags the others (keep.comp). @param rays what the
    /// shader is given besides.
    void keep(CommandStream& stream, const Bindings& rays, uint32_t count) const;
    /// A buffer of so many words for what the next chunk's rays meet.
    const Buffer& add(Device& device, uint64_t words);
    /// Frees what was taken over, and remembers where the patches of sides begin. Waits for the device.
    void remember(CommandStream& stream, const VoxelPatches& patches);
    /// Forgets all.
    void clear();

 private:
    Kernel firstPatchesOf_, renumber_, keep_;
    RegionMerge regions_;
    std::vector<Buffer> met_, before_;  ///< By chunk: a word a ray, as met.glsl has it.
    Buffer firstPatches_;               ///< By side.
    uint32_t sides_ = 0;
    Buffer addresses_, newSides_, beganAt_, boxes_;  ///< For an update.
    bool isActive_ = false;
};

}  // namespace voxray
