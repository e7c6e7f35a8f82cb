// Access to a sparse voxel octree (docs/svo.md). Nodes of all levels are numbered breadth first, root first; a level
// begins at a multiple of four. A node is a byte, the mask of its children. The masks of four nodes and the number of
// their first child are one entry of 64 bits: children of neighbours in the numbering follow each other, so that a child's
// number is that first number plus the bits set before its own.
//
// Binding 26 of set 0; the arrays stand behind addresses, since they outgrow what devices bind.
#ifndef VOXRAY_OCTREE_GLSL
#define VOXRAY_OCTREE_GLSL

#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_buffer_reference : require

#include "shaders/radiance_texel.glsl"
#include "shaders/shared/octree_types.h"
#include "shaders/shared/radiance_types.h"

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer OctreeTable { uint node[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer OctreeNodes { uvec2 four[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer OctreeValues { uvec2 data[]; };

layout(set = 0, binding = 26, scalar) readonly buffer RadianceVoxels {
    RadianceGrid grid;
    OctreeTable table;
    OctreeNodes nodes;
    OctreeValues values;  // By direction, then by node: shaders/radiance_texel.glsl.
    OctreeShape octree;
} radianceVoxels;

// Octants are numbered x + 2 y + 4 z.
uint octantOf(uvec3 cell) { return (cell.x & 1u) | (cell.y & 1u) << 1 | (cell.z & 1u) << 2; }

// Voxels of a level along each axis.
uvec3 octreeCells(uint level) { return (radianceVoxels.grid.resolution + ((1u << level) - 1u)) >> level; }

// Where the table entry of a cell of a level stands; `level` is not below the table's.
uint octreeTableEntry(uvec3 cell, uint level) {
    const uvec3 size = octreeCells(level);
    return radianceVoxels.octree.tableFirst[level - radianceVoxels.octree.tableLevel] +
           (cell.z * size.y + cell.y) * size.x + cell.x;
}

// Mask of the children of a node above level 0; 0: the node is uniform and stands for all below it.
uint octreeChildren(uint node) { return radianceVoxels.nodes.four[node >> 2].x >> (8u * (node & 3u)) & 0xffu; }

// The child of a node above level 0, NO_NODE where it is empty; a uniform node itself.
uint octreeChild(uint node, uint octant) {
    const uvec2 four = radianceVoxels.nodes.four[node >> 2];
    const uint first = 8u * (node & 3u);
    if ((four.x >> first & 0xffu) == 0u) return node;
    const uint bit = 1u << (first + octant);
    return (four.x & bit) == 0u ? NO_NODE : four.y + uint(bitCount(four.x & (bit - 1u)));
}

// The node of a cell of a level: NO_NODE where the cell is empty or outside of the grid; a coarser node where that is
// uniform.
uint octreeNode(ivec3 cell, uint level) {
    if (any(greaterThanEqual(uvec3(cell), octreeCells(level)))) return NO_NODE;  // Negative ones wrap round.
    const uint top = max(level, radianceVoxels.octree.tableLevel);
    uint node = radianceVoxels.table.node[octreeTableEntry(uvec3(cell) >> (top - level), top)];
    for (uint l = top; l > level && node != NO_NODE; --l) node = octreeChild(node, octantOf(uvec3(cell) >> (l - 1u - level)));
    return node;
}

// Radiance times cover and cover of a node, nothing for NO_NODE. `face`: 0 to 5 by facing direction, 0 where all share one.
vec4 octreeValue(uint node, uint face) {
    if (node == NO_NODE) return vec4(0.0);
    return unpackRadiance(radianceVoxels.values.data[face * radianceVoxels.octree.nodeCount + node]);
}

void storeOctreeValue(uint node, uint face, vec4 value) {
    radianceVoxels.values.data[face * radianceVoxels.octree.nodeCount + node] = packRadiance(value);
}

#endif
