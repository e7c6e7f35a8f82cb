#pragma once

#include <vector>

#include "passes/common/voxels/grid_levels.h"
#include "shaders/octree/octree_types.h"
#include "vulkan/commands.h"

namespace voxray {

/// How many nodes an octree has on each level, leaves first: all that its memory depends on.
struct OctreeSize {
    glm::uvec3 resolution{};      ///< Voxels of the grid.
    std::vector<uint32_t> nodes;  ///< By level, as many as gridLevels(resolution); the last is the root.

    uint32_t levels() const { return uint32_t(nodes.size()); }
    /// Number of the first node of each level: the root is 1, leaves come last.
    std::vector<uint32_t> first() const;
    uint32_t nodeCount() const { return first().front() + nodes.front(); }
    /// The finest level whose table has at most two words for each leaf; at most the level above the root. So
    /// the table grows with the surface alone, and what it leaves to descend is short where surfaces are
    /// dense.
    uint32_t tableLevel() const;

    uint64_t tableBytes() const, nodeBytes() const;
};

/// Which voxels there are on each level, without any values: those are arrays of their own, by a node's
/// number. GLSL access: shaders/octree/octree.glsl.
struct Octree {
    OctreeSize size;
    Buffer header;      ///< OctreeShape, and the addresses of `table` and `nodes`.
    Buffer table;       ///< A word a voxel, from tableLevel() on up.
    Buffer nodes;       ///< A word a node above the leaves.
    Buffer leafVoxels;  ///< The coordinates of each leaf's surface voxel, 10 bits each.

    std::vector<Binding> bindings() const { return {{"octree", header}}; }
};

/// An octree without a list of its leaves. Nodes are undefined; the table holds the level above the root and
/// nothing else.
/// @throws Error for more than OCTREE_MAX_LEVELS or OCTREE_MAX_NODES.
Octree allocateOctree(CommandStream& stream, const OctreeSize& size);

}  // namespace voxray
