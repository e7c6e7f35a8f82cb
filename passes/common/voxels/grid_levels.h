#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <glm/vec3.hpp>

namespace voxray {

/// Levels from a grid's voxels to a single voxel round them all; the voxels of each are twice as wide as
/// those of the level below.
inline uint32_t gridLevels(glm::uvec3 resolution) {
    return uint32_t(std::bit_width(std::max({resolution.x, resolution.y, resolution.z}) - 1)) + 1;
}

/// Voxels of a level along each axis, of a grid of `resolution`: half as many as of the level below, rounded
/// up.
inline glm::uvec3 levelResolution(glm::uvec3 resolution, uint32_t level) {
    return (resolution + ((1u << level) - 1u)) >> level;
}

}  // namespace voxray
