#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <glm/vec3.hpp>

namespace voxray {

/// Number of levels from a grid's voxels to a single voxel; the voxels of each are twice as wide as those of
/// the next finer level.
inline uint32_t gridLevels(glm::uvec3 resolution) {
    return uint32_t(std::bit_width(std::max({resolution.x, resolution.y, resolution.z}) - 1)) + 1;
}

/// Voxels of a level along each axis: half as many as of the next finer level, rounded up.
inline glm::uvec3 levelResolution(glm::uvec3 resolution, uint32_t level) {
    return (resolution + ((1u << level) - 1u)) >> level;
}

/// Number of a level's voxels.
inline uint64_t levelVoxels(glm::uvec3 resolution, uint32_t level) {
    const glm::uvec3 size = levelResolution(resolution, level);
    return uint64_t(size.x) * size.y * size.z;
}

}  // namespace voxray
