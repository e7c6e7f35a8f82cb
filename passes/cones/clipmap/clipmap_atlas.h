#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "passes/cones/clipmap/clipmap_windows.h"

namespace voxray {

/// A 3D texture atlas of a clipmap's windows: a block for each level and face, those of a level side by side
/// along x, each with a border of one texel (passes/cones/radiance/radiance_clipmap_textures.glsl).
struct ClipmapAtlas {
    glm::uvec3 extent{0};            ///< Texels.
    std::vector<glm::uvec3> blocks;  ///< By level: texel of the first voxel of the first face.
};

/// Packs levels into rows along y, no longer than the finest level's block; rows follow each other along z.
/// @param directions values per voxel.
ClipmapAtlas packAtlas(const ClipmapWindows& windows, uint32_t levels, uint32_t directions);

}  // namespace voxray
