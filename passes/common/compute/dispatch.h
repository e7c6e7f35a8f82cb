#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

namespace voxray {

/// Work groups of 64 threads for `count` items, folded into rows of 32768 groups (devices allow 65535 along
/// an axis). GLSL counterpart: linearIndex() in shaders/compute/linear_index.glsl.
inline glm::uvec3 linearGroups(uint64_t count) {
    const uint64_t groups = (count + 63) / 64;
    constexpr uint64_t kRow = 32768;
    if (groups <= kRow) return {uint32_t(groups), 1, 1};
    return {uint32_t(kRow), uint32_t((groups + kRow - 1) / kRow), 1};
}

/// Work groups of 8x8 threads for the pixels of an image.
inline glm::uvec3 pixelGroups(uint32_t width, uint32_t height) {
    return {(width + 7) / 8, (height + 7) / 8, 1};
}

}  // namespace voxray
