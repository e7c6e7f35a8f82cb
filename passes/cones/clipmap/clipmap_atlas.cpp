#include "passes/cones/clipmap/clipmap_atlas.h"

#include <glm/common.hpp>

namespace voxray {

ClipmapAtlas packAtlas(const ClipmapWindows& windows, uint32_t levels, uint32_t directions) {
    ClipmapAtlas atlas;
    glm::uvec3 corner(0);
    uint32_t rowLength = 0, rowDepth = 0;
    for (uint32_t level = 0; level < levels; ++level) {
        const glm::uvec3 block = windows.window(level, {}).size + 2u;
        if (level == 0) rowLength = block.y;
        if (corner.y + block.y > rowLength) {
            corner = {0, 0, corner.z + rowDepth};
            rowDepth = 0;
        }
        rowDepth = glm::max(rowDepth, block.z);
        atlas.blocks.push_back(corner + 1u);
        atlas.extent = glm::max(atlas.extent, corner + glm::uvec3(block.x * directions, block.y, block.z));
        corner.y += block.y;
    }
    return atlas;
}

}  // namespace voxray
