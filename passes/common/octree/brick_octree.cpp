#include "passes/common/octree/brick_octree.h"

#include <algorithm>
#include <utility>

#include "base/error.h"

namespace voxray {
namespace {

using gpu::BrickNode;
static_assert(sizeof(BrickNode) == kBrickNodeBytes);
constexpr uint32_t kLongestAxis = 1024;  // A node's place takes 10 bits an axis.

glm::ivec3 placeOf(const BrickNode& node) {
    return glm::ivec3(node.cell, node.cell >> 10, node.cell >> 20) & 0x3ff;
}

BrickNode nodeAt(glm::ivec3 cell) {
    BrickNode node{};
    node.brick = NO_BRICK;
    node.cell = uint32_t(cell.x | cell.y << 10 | cell.z << 20);
    return node;
}

/// Links the children of a node to their siblings and to those of its neighbours, whose children are made.
void linkChildren(std::vector<BrickNode>& nodes, const BrickNode& parent) {
    for (uint32_t octant = 0; octant < 8; ++octant)
        for (uint32_t side = 0; side < 6; ++side) {
            const uint32_t bit = 1u << side % 3;
            const bool fromLow = !(octant & bit), goesUp = side < 3;
            const uint32_t block = fromLow == goesUp ? parent.firstChild
                                   : parent.neighbor[side] == NO_NEIGHBOR
                                       ? NO_CHILDREN
                                       : nodes[parent.neighbor[side]].firstChild;
            if (block != NO_CHILDREN)
                nodes[parent.firstChild + octant].neighbor[side] = block + (octant ^ bit);
        }
}

}  // namespace

BrickOctree buildBrickOctree(VoxelBits voxels, bool neighbors) {
    const glm::uvec3 size = voxels.size();
    if (std::max({size.x, size.y, size.z}) > kLongestAxis)
        throw Error("an octree of bricks takes at most {} voxels along an axis; the grid has {}x{}x{}",
                    kLongestAxis, size.x, size.y, size.z);
    const std::vector<VoxelBits> bricks = brickLevels(std::move(voxels), neighbors);
    BrickOctree octree;
    std::vector<BrickNode>& nodes = octree.nodes;
    nodes.push_back(nodeAt({0, 0, 0}));
    octree.first.resize(bricks.size());
    octree.count.resize(bricks.size());
    uint32_t first = 0;
    for (size_t level = bricks.size(); level-- > 0;) {
        const uint32_t end = uint32_t(nodes.size());
        octree.first[level] = first;
        octree.count[level] = end - first;
        for (uint32_t i = first; i < end; ++i) {
            const glm::ivec3 cell = placeOf(nodes[i]);
            if (!bricks[level][cell]) continue;
            nodes[i].brick = octree.bricks++;
            if (level == 0) continue;
            nodes[i].firstChild = uint32_t(nodes.size());
            for (int octant = 0; octant < 8; ++octant)
                nodes.push_back(nodeAt(2 * cell + (glm::ivec3(octant, octant >> 1, octant >> 2) & 1)));
        }
        for (uint32_t i = first; i < end; ++i)
            if (nodes[i].firstChild != NO_CHILDREN) linkChildren(nodes, nodes[i]);
        first = end;
    }
    return octree;
}

}  // namespace voxray
