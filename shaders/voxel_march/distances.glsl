// Directional distances to the next occupied cell, for each octant of directions. A cell is a cube of voxels and has a
// word. The word of an empty cell holds for each octant, in 3 bits, the edge in cells of the empty cube that begins
// with the cell, at most 7; its low 8 bits are 0. The low 8 bits of any other cell hold the mask of its occupied
// octants, as in the words of octree nodes (shaders/octree/octree.glsl).
//
//     cells, X occupied           distances of .: 3 in the octant up and to the right, 2 up and to the left
//     - - - - X -
//     - - - - - -
//     X - - - - -
//     - - . - - -
//
// Semwal and Kvarnström 1997 (directed safe zones); Deakin and Knackstedt 2020 (anisotropic Chebyshev distance maps).
#ifndef VOXRAY_VOXEL_DISTANCES_GLSL
#define VOXRAY_VOXEL_DISTANCES_GLSL

#define MAX_DISTANCE 7
#define EMPTY_CELL_MAX_DISTANCE 0xffffff00u  // An empty cell with MAX_DISTANCE in each octant.

// Cells along each axis; a cell is 2^level voxels wide.
ivec3 cellCount(uvec3 resolution, int level) { return ivec3((resolution + ((1u << level) - 1u)) >> level); }

// Level of the octree's nodes that have distances: one above the table's level, which keeps them few, and at least 1.
int distanceLevel(uint tableLevel, uint levels) { return int(min(tableLevel + 1u, levels)); }

bool isCellEmpty(uint word) { return (word & 0xffu) == 0u; }

// Octants of directions: bits 0, 1 and 2 are set for negative components along x, y and z.
int distanceShift(uint octant) { return int(8u + 3u * octant); }
int distanceOf(uint word, uint octant) { return isCellEmpty(word) ? int(word >> distanceShift(octant) & 7u) : 0; }

#endif
