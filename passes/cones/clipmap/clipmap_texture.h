#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "passes/cones/clipmap/clipmap_windows.h"

namespace voxray {

/// Where the windows of a clipmap stand in one 3D texture: blocks of a level's faces side by side along x,
/// with a border of one texel round each (passes/cones/radiance/radiance_clipmap_textures.glsl).
struct ClipmapTexture {
    glm::uvec3 extent{0};            ///< Texels.
    std::vector<glm::uvec3> blocks;  ///< By level: texel of the first voxel of the first face.
};

/// Places levels in rows along y, no longer than the finest level's block, one row behind the other along z.
/// @param directions values a voxel.
ClipmapTexture placeInTexture(const ClipmapWindows& windows, uint32_t levels, uint32_t directions);

}  // namespace voxray
