#pragma once

#include "passes/common/voxels/voxels.h"

namespace voxray {

/// Drops voxels whose parents, the voxels twice as wide that hold them, are not in a set.
class KeepChildren {
 public:
    explicit KeepChildren(ProgramOwner& owner) : program_(owner, "keep_children.comp") {}

    /// @param bits of all voxels of `grid`, in the order of its occupancy. @param parents likewise of `parentGrid`,
    /// which has half as many voxels along each axis. Neither is a window.
    void run(CommandStream& stream, const gpu::VoxelGrid& grid, const Buffer& bits, const gpu::VoxelGrid& parentGrid,
             const Buffer& parents) const {
        const uint32_t words = uint32_t(occupancyWords(grid));
        stream.dispatch(program_, words,
                        {{"parents", parents},
                         {"bits", bits},
                         {"wordsPerRow", grid.wordsPerRow},
                         {"rows", grid.resolution.y},
                         {"parentWordsPerRow", parentGrid.wordsPerRow},
                         {"parentRows", parentGrid.resolution.y},
                         {"words", words}});
    }

 private:
    Kernel program_;
};

}  // namespace voxray
