#pragma once

#include <vector>

#include "passes/common/voxels/voxels.h"
#include "passes/cones/clipmap/clipmap_windows.h"
#include "passes/cones/radiance/radiance_types.h"

namespace voxray {

/// Surface voxels of a clipmap: those in each level's window around the camera, up to the first level whose
/// window is its whole grid. The voxels of a level are twice as wide as those of the next finer level.
struct ClipmapVoxels : Resource {
    struct Level {
        SurfaceVoxels voxels;         ///< Of the window.
        std::vector<VoxelBox> boxes;  ///< Rebuilt in this frame.
        SurfaceVoxels updated;        ///< The voxels of `boxes` only; empty if these are the window.
    };
    gpu::RadianceGrid grid{};  ///< Of the whole scene and all levels.
    ClipmapWindows windows;
    std::vector<Level> levels;

    std::vector<const Buffer*> checkedBuffers() const override {
        std::vector<const Buffer*> materials;
        for (const Level& level : levels) materials.push_back(&level.voxels.materials);
        return materials;
    }
};

}  // namespace voxray
