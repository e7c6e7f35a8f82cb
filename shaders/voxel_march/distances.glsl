// How far space is empty before a cell, for each octant of directions. A cell is a cube of voxels, and has a word. An empty one's tells
// how many cells along each axis, itself included, are empty from it on: at most 7, in 3 bits for each octant, above 8 bits that are 0.
// Any other's has in these 8 bits the mask of its octants, as the nodes of an octree have (shaders/octree/octree.glsl).
//
//     cells, X not empty          from . on upwards and to the right: 3 cells, to the left: 2
//     - - - - X -
//     - - - - - -
//     X - - - - -
//     - - . - - -
//
// Semwal and Kvarnström 1997 (directed safe zones); Deakin and Knackstedt 2020 (anisotropic Chebyshev distance maps).
#ifndef VOXRAY_VOXEL_DISTANCES_GLSL
#define VOXRAY_VOXEL_DISTANCES_GLSL

#define MAX_DISTANCE 7
#define FAR_FROM_ALL 0xffffff00u  // An empty cell, as far from others as can be told.

// Cells along each axis, 2^level voxels wide; they stand in rows along x.
ivec3 cellCount(uvec3 resolution, int level) { return ivec3((resolution + ((1u << level) - 1u)) >> level); }

// The level of the octree whose nodes have distances: one above its table's, so that there are few, and at least 1.
int distanceLevel(uint tableLevel, uint levels) { return int(min(tableLevel + 1u, levels)); }

bool isCellEmpty(uint word) { return (word & 0xffu) == 0u; }

// Octants of directions: bit 0, 1, 2 is set for those down along x, y, z.
int distanceShift(uint octant) { return int(8u + 3u * octant); }
int distanceOf(uint word, uint octant) { return isCellEmpty(word) ? int(word >> distanceShift(octant) & 7u) : 0; }

#endif
