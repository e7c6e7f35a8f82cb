#include "passes/cones/clipmap/clipmap_texture.h"

#include <glm/common.hpp>

namespace voxray {

ClipmapTexture placeInTexture(const ClipmapWindows& windows, uint32_t levels, uint32_t directions) {
    ClipmapTexture texture;
    glm::uvec3 at(0);
    uint32_t rowLength = 0, rowDepth = 0;
    for (uint32_t level = 0; level < levels; ++level) {
        const glm::uvec3 block = windows.window(level, {}).size + 2u;
        if (level == 0) rowLength = block.y;
        if (at.y + block.y > rowLength) {
            at = {0, 0, at.z + rowDepth};
            rowDepth = 0;
        }
        rowDepth = glm::max(rowDepth, block.z);
        texture.blocks.push_back(at + 1u);
        texture.extent = glm::max(texture.extent, at + glm::uvec3(block.x * directions, block.y, block.z));
        at.y += block.y;
    }
    return texture;
}

}  // namespace voxray
