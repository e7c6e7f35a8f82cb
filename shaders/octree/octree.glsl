// Access to the structure of a sparse voxel octree (docs/svo.md): which voxels there are on each level, without any values. Nodes
// are numbered from 1 on, breadth first, root first: the children of a node follow each other, and so do those of neighbours in the
// numbering. Whoever stores values has an array by number. A node above level 0 is a word: the mask of its children in 8 bits and
// the number of the first of them in 24. So 0 is a node without anything, and number 0 is none.
//
// A node may also stand for all below it, where whoever stores values found them to be uniform (passes/cones/filter_voxels/svo_collapse.h):
// then its word has no mask and its own number. An octree as it is built has none of these.
//
// From one level on up the words also stand in a table, by voxel: a full grid for each level with a border of one voxel, up to
// one level above the root.
//
// A leaf leads to its surface voxel by its coordinates, a list of its own (Octree::leafVoxels; unpackCell()), and voxelNumber() of
// shaders/voxels/voxels.glsl; a voxel leads to its leaf by octreeLeaf().
//
// The arrays stand behind addresses, since they outgrow what devices bind.
#ifndef VOXRAY_OCTREE_GLSL
#define VOXRAY_OCTREE_GLSL


#include "shaders/octree/octree_cells.glsl"
#include "shaders/octree/octree_types.h"

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer OctreeWords { uint data[]; };

layout(scalar) readonly buffer Octree {
    OctreeWords table;
    OctreeWords nodes;  // By number, those above level 0.
    OctreeShape shape;
} octree;

uint octreeMask(uint word) { return word & 0xffu; }
bool isUniform(uint word) { return word != 0u && octreeMask(word) == 0u; }

// Number of a child, NO_NODE where it is empty; of a uniform node, itself.
uint octreeChild(uint word, uint octant) {
    const uint mask = octreeMask(word), bit = 1u << octant, first = word >> 8;
    if (mask == 0u) return first;
    return (mask & bit) == 0u ? NO_NODE : first + uint(bitCount(mask & (bit - 1u)));
}

// Voxels of a level along each axis.
ivec3 octreeSize(uint level) { return ivec3((octree.shape.resolution + ((1u << level) - 1u)) >> level); }

// Whether a voxel is in a level or an adjacent one.
bool inOctreeBorder(ivec3 voxel, uint level) {
    return all(greaterThanEqual(voxel, ivec3(-1))) && all(lessThanEqual(voxel, octreeSize(level)));
}

// Where the word of a voxel stands in the table, for a level from the table's on up; the voxel may be in the border.
uint octreeTableEntry(ivec3 voxel, uint level) {
    const uvec3 size = uvec3(octreeSize(level) + 2), at = uvec3(voxel + 1);
    return octree.shape.tableFirst[level - octree.shape.tableLevel] + (at.z * size.y + at.y) * size.x + at.x;
}

// The word of a voxel of a level above 0, in the level or its border: 0 where it is empty; of a coarser node where that is uniform.
uint octreeWord(ivec3 voxel, uint level) {
    const uint top = max(level, octree.shape.tableLevel);
    uint word = octree.table.data[octreeTableEntry(voxel >> (top - level), top)];
    for (uint l = top; l > level; --l) word = octree.nodes.data[octreeChild(word, octantOf(voxel >> (l - 1u - level)))];
    return word;
}

// The numbers of the eight voxels from `corner` on, by octant; whether there is any node. This is where the time of a sample goes:
// what the eight have in common is worked out once, and where the table's level allows there is no descent.
bool octreeNodes(ivec3 corner, uint level, out uint node[8]) {
    const uint top = max(level + 1u, octree.shape.tableLevel), up = top - level;
    const ivec3 size = octreeSize(top) + 2, low = (corner >> up) + 1, high = ((corner + 1) >> up) + 1;
    const uint first = octree.shape.tableFirst[top - octree.shape.tableLevel];
    const uvec2 x = uvec2(low.x, high.x), y = size.x * uvec2(low.y, high.y), z = first + size.x * size.y * uvec2(low.z, high.z);
    for (uint cell = 0u; cell < 8u; ++cell)
        node[cell] = octree.table.data[x[cell & 1u] + y[cell >> 1 & 1u] + z[cell >> 2]];
    uint found = 0u;
    for (uint l = up - 1u; l > 0u; --l)
        for (uint cell = 0u; cell < 8u; ++cell)
            node[cell] = octree.nodes.data[octreeChild(node[cell], octantOf((corner + octantOffset(cell)) >> l))];
    for (uint cell = 0u; cell < 8u; ++cell) {
        node[cell] = octreeChild(node[cell], octantOf(corner + octantOffset(cell)));
        found |= node[cell];
    }
    return found != 0u;
}

// The leaf of a voxel of the grid, counted from 0 on; NO_LEAF where the voxel is empty or not in the grid.
#define NO_LEAF 0xffffffffu
uint octreeLeaf(ivec3 voxel) {
    if (any(lessThan(voxel, ivec3(0))) || any(greaterThanEqual(voxel, ivec3(octree.shape.resolution)))) return NO_LEAF;
    const uint node = octreeChild(octreeWord(voxel >> 1, 1u), octantOf(voxel));
    return node == NO_NODE ? NO_LEAF : node - octree.shape.firstLeaf;
}

#endif
