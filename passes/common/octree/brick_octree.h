#pragma once

#include <vector>

#include "graph/pass.h"
#include "passes/common/compute/large_buffer.h"
#include "passes/common/octree/brick_octree_count.h"
#include "shaders/octree/brick_octree_types.h"
#include "shaders/voxels/voxel_types.h"

namespace voxray {

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
    BrickOctreeCount expected;            ///< About what it will hold; likewise.
    bool moves = false;                   ///< Whether it has a dynamic section; likewise.
    LargeBuffer nodes;                    ///< gpu::BrickNode each; may have room for more.
    std::vector<gpu::LevelNodes> levels;  ///< Leaves first.
    uint32_t nodeCount = 0, brickCount = 0;
    uint32_t staticNodes = 0, staticBricks = 0;  ///< Of these, in the static section.
    uint64_t version = 0;                        ///< Another one whenever the content is.

    /// Nodes that the pool has room for at first: a few more than expected, since floats on the device may
    /// take a sample on an edge that doubles don't, and an eighth more where surfaces move.
    uint64_t room() const { return expected.nodes() + expected.nodes() / (moves ? 8 : 256) + 64; }
    /// Bytes that building takes besides while it runs: where surfaces move the pool may outgrow that room,
    /// and is there twice while it is copied.
    uint64_t copyBytes() const { return moves ? room() * kBrickNodeBytes : 0; }
};

}  // namespace voxray
