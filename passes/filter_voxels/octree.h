#pragma once

#include <vector>

#include "passes/common/voxels.h"
#include "shaders/shared/octree_types.h"

namespace voxray {

/// How many nodes an octree has on each level, leaves first: all that its memory depends on.
struct OctreeSize {
    glm::uvec3 resolution{};      ///< Voxels of the grid.
    uint32_t directions = 1;      ///< Values a node: 1 or 6.
    std::vector<uint32_t> nodes;  ///< By level; the last is the root, 1.

    uint32_t levels() const { return uint32_t(nodes.size()) - 1; }
    /// Number of the first node of each level: root first, each level at a multiple of four.
    std::vector<uint32_t> first() const;
    uint32_t nodeCount() const { return first().front() + nodes.front(); }
    /// The finest level whose cells, empty ones included, are at most half as many as the leaves.
    uint32_t tableLevel() const;
    uint64_t tableBytes() const, nodeBytes() const, valueBytes() const;
    /// Of the octree, as RadianceOctree holds it; exact.
    uint64_t bytes() const;
};

/// Levels above the leaves that enclose a grid: at least 1.
uint32_t octreeLevels(glm::uvec3 resolution);

/// Voxels along each axis of a grid, at a level.
inline glm::uvec3 octreeCells(glm::uvec3 resolution, uint32_t level) {
    return (resolution + ((1u << level) - 1u)) >> level;
}

/// A sparse octree of radiance and opacity: docs/svo.md. GLSL access: shaders/octree.glsl.
struct RadianceOctree {
    /// Allocates what `size` needs and writes the header; the arrays' content is undefined, but for the
    /// table, which finds the root and nothing else.
    RadianceOctree(CommandStream& stream, const gpu::VoxelGrid& voxelGrid, OctreeSize counted);

    uint64_t bytes() const { return header.bytes() + table.bytes() + nodes.bytes() + values.bytes(); }

    gpu::VoxelGrid grid{};
    OctreeSize size;
    std::vector<uint32_t> first;  ///< OctreeSize::first().
    Buffer header;                ///< The block RadianceOctree of shaders/octree.glsl.
    Buffer table;                 ///< Node numbers of the cells from tableLevel() on up.
    Buffer nodes;                 ///< Four nodes' masks of children and the number of their first child.
    Buffer values;                ///< 64 bits by direction and node: shaders/radiance_texel.glsl.
};

}  // namespace voxray
