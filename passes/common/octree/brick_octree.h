#pragma once

#include <vector>

#include "graph/pass.h"
#include "passes/common/compute/large_buffer.h"
#include "shaders/octree/brick_octree_types.h"
#include "shaders/voxels/voxel_types.h"

namespace voxray {

constexpr uint64_t kBrickNodeBytes = 11 * sizeof(uint32_t), kBrickBytes = 27 * sizeof(uint32_t);

/// Number of nodes of a level, in both sections.
inline uint32_t nodesOf(const gpu::LevelNodes& level) {
    return level.staticCount + level.dynamicCount;
}

/// The octree of Arnebäck 2017, chapter 3, as published: a pool of nodes, level by level from the root, in
/// blocks of eight siblings. Nodes of static surfaces are in the pool's static section, those of moving ones
/// in the dynamic section behind it. A leaf or subdivided node has a brick of 3x3x3 values; bricks are
/// numbered like nodes, and stored by their users. GLSL: shaders/octree/brick_octree.glsl.
struct BrickOctree : Resource {
    gpu::VoxelGrid grid{};                ///< Its voxels are the leaves; known from plan() on.
    bool moves = false;                   ///< Whether surfaces move; known from plan() on.
    LargeBuffer nodes;                    ///< gpu::BrickNode each; may have unused capacity.
    std::vector<gpu::LevelNodes> levels;  ///< Leaves first.
    uint32_t nodeCount = 0, brickCount = 0;
    uint32_t staticNodes = 0, staticBricks = 0;  ///< The number of these in the static section.
};

}  // namespace voxray
