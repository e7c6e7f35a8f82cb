#pragma once

#include <vector>

#include "passes/common/radiance_voxels.h"
#include "shaders/shared/octree_types.h"

namespace voxray {

/// How many nodes an octree has on each level, leaves first: all that its memory depends on.
struct OctreeSize {
    glm::uvec3 resolution{};      ///< Voxels of the grid.
    uint32_t directions = 1;      ///< Values a node: 1 or 6.
    std::vector<uint32_t> nodes;  ///< By level, as many as radianceLevels(resolution); the last is the root.

    uint32_t levels() const { return uint32_t(nodes.size()); }
    /// Number of the first node of each level: root first, each level at a multiple of four.
    std::vector<uint32_t> first() const;
    uint32_t nodeCount() const { return first().front() + nodes.front(); }
    /// The finest level above the leaves with at most half as many voxels, empty ones included, as there are
    /// leaves; else the root's.
    uint32_t tableLevel() const;

    uint64_t tableBytes() const, nodeBytes() const, valueBytes() const;
    /// Of all that allocateOctree() makes; exact.
    uint64_t bytes() const;
};

/// The buffers of an octree in RadianceVoxels::storage. GLSL access: shaders/octree.glsl.
enum OctreeStorage : size_t {
    kOctreeTable,   ///< Node numbers of a level's voxels, from tableLevel() on up.
    kOctreeNodes,   ///< Four nodes' masks of children and the number of their first child: 64 bits.
    kOctreeValues,  ///< 64 bits by direction and node (shaders/radiance_texel.glsl).
};

/// Gives `radiance`, whose grid is set, the buffers of an octree and their header. The content is undefined
/// but for the table, which finds the root and nothing else.
/// @throws Error for more levels than OCTREE_MOST_LEVELS, and over the memory limit, naming the bytes needed.
void allocateOctree(CommandStream& stream, const OctreeSize& size, RadianceVoxels& radiance);

}  // namespace voxray
