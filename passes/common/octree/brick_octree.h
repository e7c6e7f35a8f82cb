#pragma once

#include <vector>

#include "graph/pass.h"
#include "passes/common/compute/large_buffer.h"
#include "shaders/octree/brick_octree_types.h"
#include "shaders/voxels/voxel_types.h"

namespace voxray {

/// The octree of Arnebäck 2017, chapter 3, as published: nodes of 11 words in blocks of eight siblings, and
/// for each node that is subdivided or a leaf a brick of 3x3x3 values of 8 bits a channel at its corners, the
/// centers of its edges and faces, and its own.
constexpr uint64_t kBrickNodeBytes = 11 * sizeof(uint32_t), kBrickBytes = 27 * sizeof(uint32_t);

/// Nodes of a level, in both sections.
inline uint32_t nodesOf(const gpu::LevelNodes& level) {
    return level.staticCount + level.dynamicCount;
}

/// The nodes of Arnebäck 2017's octree, chapter 3: a root, then level by level, siblings in blocks of eight.
/// Nodes of what stays form the static section of the pool, those of what moves the dynamic one behind it.
/// Bricks are numbered likewise; whoever uses them holds their values. GLSL:
/// shaders/octree/brick_octree.glsl.
struct BrickOctree : Resource {
    gpu::VoxelGrid grid{};                ///< Its voxels are the leaves; known from plan() on.
    bool moves = false;                   ///< Whether surfaces move; likewise.
    LargeBuffer nodes;                    ///< gpu::BrickNode each; may have room for more.
    std::vector<gpu::LevelNodes> levels;  ///< Leaves first.
    uint32_t nodeCount = 0, brickCount = 0;
    uint32_t staticNodes = 0, staticBricks = 0;  ///< Of these, in the static section.
};

}  // namespace voxray
