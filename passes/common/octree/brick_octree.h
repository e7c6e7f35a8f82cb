#pragma once

#include <vector>

#include "passes/common/octree/brick_octree_count.h"
#include "shaders/octree/brick_octree_types.h"

namespace voxray {

/// The nodes of Arnebäck 2017's octree, linked: shaders/octree/brick_octree.glsl reads them.
struct BrickOctree {
    std::vector<gpu::BrickNode> nodes;  ///< The root, then level by level, siblings in blocks of eight.
    std::vector<uint32_t> first;        ///< Number of the first node of each level, leaves first.
    std::vector<uint32_t> count;        ///< Nodes of each level, likewise.
    uint32_t bricks = 0;                ///< Numbered in the order of their nodes.
};

/// Builds it over the voxels that surfaces pass through; brickLevels() says which nodes get a brick.
/// @throws Error for more than 1024 voxels along an axis.
BrickOctree buildBrickOctree(VoxelBits voxels, bool neighbors);

}  // namespace voxray
