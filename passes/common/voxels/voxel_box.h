#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

namespace voxray {

/// A box of voxels in a grid or one of its levels.
struct VoxelBox {
    glm::ivec3 first{0};
    glm::uvec3 size{0};
    uint64_t count() const { return uint64_t(size.x) * size.y * size.z; }
};

}  // namespace voxray
