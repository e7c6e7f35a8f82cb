// Access to a sparse voxel octree (docs/svo.md). Nodes are numbered from 1 on, breadth first, root first: the children of a node
// follow each other, and so do those of neighbours in the numbering. A node above level 0 is a word: the mask of its children in
// 8 bits and the number of the first of them in 24; or, for a uniform node, which stands for all below it, no mask and its own
// number. So 0 is a node without anything, number 0 is none, and its values are 0.
//
// From one level on up the words also stand in a table, by voxel: a full grid for each level with a border of one voxel, up to
// one level above the root.
//
// The arrays stand behind addresses, since they outgrow what devices bind.
#ifndef VOXRAY_OCTREE_GLSL
#define VOXRAY_OCTREE_GLSL

#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_buffer_reference : require

#include "shaders/radiance/radiance_texel.glsl"
#include "shaders/octree/octree_types.h"
#include "shaders/radiance/radiance_types.h"

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer OctreeWords { uint data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer OctreeValues { uvec2 data[]; };

layout(scalar) readonly buffer RadianceVoxels {
    RadianceGrid grid;
    OctreeWords table;
    OctreeWords nodes;    // By number, those above level 0.
    OctreeValues values;  // By direction, then by number: shaders/radiance/radiance_texel.glsl.
    OctreeShape octree;
} radianceVoxels;

// Octants are numbered x + 2 y + 4 z.
uint octantOf(ivec3 voxel) { return uint((voxel.x & 1) | (voxel.y & 1) << 1 | (voxel.z & 1) << 2); }
ivec3 octantOffset(uint octant) { return ivec3(octant & 1u, octant >> 1 & 1u, octant >> 2); }

uint octreeMask(uint word) { return word & 0xffu; }
bool isUniform(uint word) { return word != 0u && octreeMask(word) == 0u; }

// Number of a child, NO_NODE where it is empty; of a uniform node, itself.
uint octreeChild(uint word, uint octant) {
    const uint mask = octreeMask(word), bit = 1u << octant, first = word >> 8;
    if (mask == 0u) return first;
    return (mask & bit) == 0u ? NO_NODE : first + uint(bitCount(mask & (bit - 1u)));
}

// Voxels of a level along each axis.
ivec3 octreeSize(uint level) { return ivec3((radianceVoxels.grid.resolution + ((1u << level) - 1u)) >> level); }

// Whether a voxel is in a level or one beside it.
bool inOctreeBorder(ivec3 voxel, uint level) {
    return all(greaterThanEqual(voxel, ivec3(-1))) && all(lessThanEqual(voxel, octreeSize(level)));
}

// Where the word of a voxel stands in the table, for a level from the table's on up; the voxel may be in the border.
uint octreeTableEntry(ivec3 voxel, uint level) {
    const uvec3 size = uvec3(octreeSize(level) + 2), at = uvec3(voxel + 1);
    return radianceVoxels.octree.tableFirst[level - radianceVoxels.octree.tableLevel] + (at.z * size.y + at.y) * size.x + at.x;
}

// The word of a voxel of a level above 0, in the level or its border: 0 where it is empty; of a coarser node where that is uniform.
uint octreeWord(ivec3 voxel, uint level) {
    const uint top = max(level, radianceVoxels.octree.tableLevel);
    uint word = radianceVoxels.table.data[octreeTableEntry(voxel >> (top - level), top)];
    for (uint l = top; l > level; --l) word = radianceVoxels.nodes.data[octreeChild(word, octantOf(voxel >> (l - 1u - level)))];
    return word;
}

// The numbers of the eight voxels from `corner` on, by octant; whether there is any node. This is where the time of a sample goes:
// what the eight have in common is worked out once, and where the table's level allows there is no descent.
bool octreeNodes(ivec3 corner, uint level, out uint node[8]) {
    const uint top = max(level + 1u, radianceVoxels.octree.tableLevel), up = top - level;
    const ivec3 size = octreeSize(top) + 2, low = (corner >> up) + 1, high = ((corner + 1) >> up) + 1;
    const uint first = radianceVoxels.octree.tableFirst[top - radianceVoxels.octree.tableLevel];
    const uvec2 x = uvec2(low.x, high.x), y = size.x * uvec2(low.y, high.y), z = first + size.x * size.y * uvec2(low.z, high.z);
    for (uint cell = 0u; cell < 8u; ++cell)
        node[cell] = radianceVoxels.table.data[x[cell & 1u] + y[cell >> 1 & 1u] + z[cell >> 2]];
    uint found = 0u;
    for (uint l = up - 1u; l > 0u; --l)
        for (uint cell = 0u; cell < 8u; ++cell)
            node[cell] = radianceVoxels.nodes.data[octreeChild(node[cell], octantOf((corner + octantOffset(cell)) >> l))];
    for (uint cell = 0u; cell < 8u; ++cell) {
        node[cell] = octreeChild(node[cell], octantOf(corner + octantOffset(cell)));
        found |= node[cell];
    }
    return found != 0u;
}

// Radiance times cover and cover of a node, nothing for NO_NODE. `face`: 0 to 5 by facing direction, 0 where all share one.
vec4 radianceValue(uint node, uint face) {
    return unpackRadiance(radianceVoxels.values.data[face * radianceVoxels.octree.nodeCount + node]);
}

#endif
