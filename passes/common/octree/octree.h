#pragma once

#include <vector>

#include "passes/common/radiance/radiance_voxels.h"
#include "shaders/octree/octree_types.h"

namespace voxray {

/// How many nodes an octree has on each level, leaves first: all that its memory depends on.
struct OctreeSize {
    glm::uvec3 resolution{};      ///< Voxels of the grid.
    uint32_t directions = 1;      ///< Values a node: 1 or 6.
    std::vector<uint32_t> nodes;  ///< By level, as many as radianceLevels(resolution); the last is the root.

    uint32_t levels() const { return uint32_t(nodes.size()); }
    /// Number of the first node of each level: the root is 1, leaves come last.
    std::vector<uint32_t> first() const;
    uint32_t nodeCount() const { return first().front() + nodes.front(); }
    /// The finest level whose table has at most two words for each leaf; at most the level above the root. So
    /// the table grows with the surface alone, and what it leaves to descend is short where surfaces are
    /// dense.
    uint32_t tableLevel() const;

    uint64_t tableBytes() const, nodeBytes() const, valueBytes() const;
    /// Of all that allocateOctree() makes; exact.
    uint64_t bytes() const;
};

/// The buffers of an octree in RadianceVoxels::storage. GLSL access: shaders/octree/octree.glsl.
enum OctreeStorage : size_t {
    kOctreeTable,   ///< A word a voxel, from tableLevel() on up.
    kOctreeNodes,   ///< A word a node above the leaves.
    kOctreeValues,  ///< 64 bits by direction and node (shaders/radiance/radiance_texel.glsl).
};

/// Gives `radiance`, whose grid is set, the buffers of an octree and their header. Nodes and values are
/// undefined; the table holds the level above the root and nothing else.
/// @throws Error for more than OCTREE_MAX_LEVELS or OCTREE_MAX_NODES, and over the memory limit, naming the
/// number needed.
void allocateOctree(CommandStream& stream, const OctreeSize& size, RadianceVoxels& radiance);

}  // namespace voxray
