// The structure of a sparse voxel octree (docs/svo.md): the nonempty voxels of each level, without values. Values are
// arrays indexed by node. Nodes are indexed from 1, breadth first from the root, so that the children of a node are
// consecutive. The word of a node above level 0 holds the mask of its children in the low 8 bits and the index of the
// first child in the upper 24. A word of 0 is an empty voxel; index 0 is NO_NODE.
//
// A uniform node replaces its descendants (passes/cones/filter_voxels/svo_collapse.h): its word has an empty mask and
// its own index. OctreeBuilder makes none.
//
// A table holds the words of levels from tableLevel up as well, by voxel: for each of these levels, and for one level
// above the root, a full grid with a border of one voxel.
//
// The voxel of a leaf is in Octree::leafVoxels, packed by packCell().
#ifndef VOXRAY_OCTREE_GLSL
#define VOXRAY_OCTREE_GLSL

#include "shaders/octree/octree_cells.glsl"
#include "shaders/octree/octree_types.h"

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer OctreeWords { uint data[]; };

// Arrays by address: they may exceed maxStorageBufferRange.
layout(scalar) readonly buffer Octree {
    OctreeWords table;
    OctreeWords nodes;  // Words of the nodes above level 0.
    OctreeShape shape;
} octree;

uint octreeMask(uint word) { return word & 0xffu; }
bool isUniform(uint word) { return word != 0u && octreeMask(word) == 0u; }

// Index of a child; NO_NODE where it is empty. The child of a uniform node is the node itself.
uint octreeChild(uint word, uint octant) {
    const uint mask = octreeMask(word), bit = 1u << octant, first = word >> 8;
    if (mask == 0u) return first;
    return (mask & bit) == 0u ? NO_NODE : first + uint(bitCount(mask & (bit - 1u)));
}

// Voxels of a level along each axis.
ivec3 octreeSize(uint level) { return ivec3((octree.shape.resolution + ((1u << level) - 1u)) >> level); }

// Whether a voxel is in a level's grid or in the border of one voxel around it.
bool inOctreeBorder(ivec3 voxel, uint level) {
    return all(greaterThanEqual(voxel, ivec3(-1))) && all(lessThanEqual(voxel, octreeSize(level)));
}

// Index in the table of the word of a voxel, which may be in the border. `level`: tableLevel or above.
uint octreeTableEntry(ivec3 voxel, uint level) {
    const uvec3 size = uvec3(octreeSize(level) + 2), cell = uvec3(voxel + 1);
    return octree.shape.tableFirst[level - octree.shape.tableLevel] + (cell.z * size.y + cell.y) * size.x + cell.x;
}

// The word of a voxel of a level above 0, which may be in the border: 0 where it is empty; that of a uniform ancestor,
// if there is one.
uint octreeWord(ivec3 voxel, uint level) {
    const uint top = max(level, octree.shape.tableLevel);
    uint word = octree.table.data[octreeTableEntry(voxel >> (top - level), top)];
    for (uint l = top; l > level; --l) word = octree.nodes.data[octreeChild(word, octantOf(voxel >> (l - 1u - level)))];
    return word;
}

// Nodes of the 2x2x2 voxels from `corner` on, by octant; false where all are empty. The inner loop of cone tracing: all
// eight share one computation of table rows, and there is no descent for levels whose parents are in the table.
bool octreeNodes(ivec3 corner, uint level, out uint node[8]) {
    const uint top = max(level + 1u, octree.shape.tableLevel), up = top - level;
    const ivec3 size = octreeSize(top) + 2, low = (corner >> up) + 1, high = ((corner + 1) >> up) + 1;
    const uint first = octree.shape.tableFirst[top - octree.shape.tableLevel];
    const uvec2 x = uvec2(low.x, high.x), y = size.x * uvec2(low.y, high.y),
                z = first + size.x * size.y * uvec2(low.z, high.z);
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

#endif
