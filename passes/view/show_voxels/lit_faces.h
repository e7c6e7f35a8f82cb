#pragma once

#include "passes/clusters/cluster_light.h"
#include "passes/clusters/cluster_visibility.h"
#include "passes/clusters/voxel_patches.h"

namespace voxray {

/// Counts the lit voxel faces that each voxel face sees. Source: Cosin and Patow 2022, figure 13, which
/// counts lit voxels.
class LitFaces {
 public:
    explicit LitFaces(ProgramOwner& owner);

    void count(CommandStream& stream, uint32_t voxels, const VoxelPatches& patches, const ClusterVisibility& visibility,
               const ClusterLight& light);
    /// By voxel and face: the count plus 1; 0 where no surface faces that way.
    const Buffer& visibleLitPatches() const { return visibleLitPatches_; }

 private:
    Kernel countLitPatches_, countVisibleLit_;
    Buffer litPatches_, visibleLitPatches_;
};

}  // namespace voxray
