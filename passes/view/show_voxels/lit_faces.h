#pragma once

#include "passes/clusters/cluster_light.h"
#include "passes/clusters/cluster_visibility.h"
#include "passes/clusters/voxel_patches.h"

namespace voxray {

/// How many lit faces of voxels each voxel face sees. Source: Cosin and Patow 2022, figure 13, which counts
/// lit voxels.
class LitFaces {
 public:
    explicit LitFaces(ProgramOwner& owner);

    /// Counts again.
    void count(CommandStream& stream, uint32_t voxels, const VoxelPatches& patches,
               const ClusterVisibility& visibility, const ClusterLight& light);
    /// By voxel and face: the number plus one; 0 where no surface looks that way.
    const Buffer& visibleLitPatches() const { return visibleLitPatches_; }

 private:
    Kernel countLitPatches_, countVisibleLit_;
    Buffer litPatches_, visibleLitPatches_;
};

}  // namespace voxray
