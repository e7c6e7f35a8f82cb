#pragma once

#include <vector>

#include "passes/common/voxels/grid_levels.h"
#include "shaders/octree/octree_types.h"
#include "vulkan/commands.h"

namespace voxray {

/// Numbers of an octree's nodes by level, which determine its memory.
struct OctreeSize {
    glm::uvec3 resolution{};      ///< Voxels of the grid.
    std::vector<uint32_t> nodes;  ///< By level, as many as gridLevels(resolution); the last is the root.

    uint32_t levels() const { return uint32_t(nodes.size()); }
    /// Index of the first node of each level: the root is 1, leaves come last.
    std::vector<uint32_t> first() const;
    uint32_t nodeCount() const { return first().front() + nodes.front(); }
    /// The finest level whose table has at most two words per leaf; at most the level above the root. So the
    /// table's memory grows with the surface only, and descents are short where surfaces are dense.
    uint32_t tableLevel() const;

    uint64_t tableBytes() const, nodeBytes() const;
};

/// The structure of a sparse voxel octree: the nonempty voxels of each level, without values, which are
/// arrays indexed by node. GLSL access: shaders/octree/octree.glsl.
struct Octree {
    OctreeSize size;
    Buffer header;      ///< Addresses of `table` and `nodes`, and gpu::OctreeShape.
    Buffer table;       ///< A word per voxel, in levels from tableLevel() up.
    Buffer nodes;       ///< A word per node above the leaves.
    Buffer leafVoxels;  ///< Coordinates of each leaf's surface voxel, 10 bits each.

    std::vector<Binding> bindings() const { return {{"octree", header}}; }
};

/// Allocates an octree without `leafVoxels`. Nodes are undefined; the table is empty except for the level
/// above the root. @throws Error for more than OCTREE_MAX_LEVELS or OCTREE_MAX_NODES.
Octree allocateOctree(CommandStream& stream, const OctreeSize& size);

}  // namespace voxray
