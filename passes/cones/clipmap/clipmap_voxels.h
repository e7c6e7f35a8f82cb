#pragma once

#include <vector>

#include "passes/common/voxels/voxels.h"
#include "passes/cones/clipmap/clipmap_windows.h"
#include "passes/cones/radiance/radiance_types.h"

namespace voxray {

/// Surface voxels of a clipmap: of each level those in its window round the camera, up to the first level
/// that is held whole. Each level is a grid of its own, whose voxels are twice as large as those of the level
/// below.
struct ClipmapVoxels : Resource {
    struct Level {
        SurfaceVoxels voxels;         ///< All that the window holds.
        std::vector<VoxelBox> boxes;  ///< What was built again in this frame.
        SurfaceVoxels updated;  ///< The voxels of `boxes` alone; without content where these are the window.
    };
    gpu::RadianceGrid grid{};  ///< Of the whole scene, with all levels.
    ClipmapWindows windows;
    std::vector<Level> levels;

    std::vector<const Buffer*> checkedBuffers() const override {
        std::vector<const Buffer*> all;
        for (const Level& level : levels) all.push_back(&level.voxels.materials);
        return all;
    }
};

}  // namespace voxray
