#pragma once

#include <vector>

#include "passes/common/compute/prefix_sum.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {

/// A level of voxels before it is joined with others.
struct LevelSource {
    gpu::VoxelLevel level;                  ///< Its window, and what it may hold of it.
    const SurfaceVoxels* voxels = nullptr;  ///< All surface voxels of the window.
    /// Bits of the voxels that are split, so that the next finer level holds their places; null: those that lie in the
    /// finer level's box are. All levels have bits but the finest, or none has.
    const Buffer* split = nullptr;
};

/// Numbers the voxels of several levels through, so that each place is stored once.
class LevelJoin {
 public:
    explicit LevelJoin(ProgramOwner& owner);

    /// Sets all members of `joined` that voxelizing sets. @param sources the finest level first.
    void run(PassContext& context, const std::vector<LevelSource>& sources, VoxelLevels& joined) const;

 private:
    Kernel markLevel_, copyAreas_;
    PrefixSum prefixSum_;
};

}  // namespace voxray
