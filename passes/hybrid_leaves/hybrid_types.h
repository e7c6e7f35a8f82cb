// Leaves of a hybrid octree, shared by C++ (passes/hybrid_leaves/hybrid_leaves.h) and GLSL
// (passes/hybrid_leaves/hybrid_leaves.glsl).
#ifndef VOXRAY_HYBRID_TYPES_H
#define VOXRAY_HYBRID_TYPES_H

#include "shaders/shared/types.h"

// The word of a leaf: LEAF_EMPTY; or the index of its list's first item, with LIST_HAS_GROUPS for a long
// list; or, with LEAF_IS_GRID, the index of its grid.
#define LEAF_EMPTY 0xffffffffu
#define LEAF_IS_GRID 0x80000000u
#define LIST_HAS_GROUPS 0x40000000u
// A list item has two words: the triangle's box in the leaf (passes/hybrid_leaves/leaf_box.glsl), with
// LIST_ENDS in the last item of a list; and the triangle's index.
#define LIST_ENDS 0x80000000u
#define LIST_ITEM_WORDS 2u
// A list of more than LIST_GROUP triangles is divided into groups. An item before each group holds the box
// around it, so that a ray skips the group at once; the last group's has LIST_ENDS, too.
#define LIST_GROUP 3u
// Items of a list of that many triangles.
#define LIST_ITEMS(triangles) \
    ((triangles) + ((triangles) > LIST_GROUP ? ((triangles) + LIST_GROUP - 1u) / LIST_GROUP : 0u))
// Boxes are quantized to LEAF_BOX_STEPS per leaf edge, and enlarged by LEAF_BOX_MARGIN voxels for rounding of
// rays and triangles.
#define LEAF_BOX_STEPS 32
#define LEAF_BOX_MARGIN 0.015625

// Hit::triangle of a ray through hybrid leaves: a triangle's index; or, with HIT_IS_CELL, the index of a grid
// cell, whose edge in m is Hit::u; or NO_HIT; or HIT_IS_WIDE where the ray's footprint exceeds its limit, at
// Hit::t.
#define HIT_IS_CELL 0x80000000u
#define HIT_IS_WIDE 0xfffffffeu

// Cells along an edge of a grid's level: m at level 0, half as many, rounded up, at each next level.
#define GRID_EDGE(m, level) (((m) + (1u << (level)) - 1u) >> (level))

// Words of a grid cell: plane and albedo; where the scene has emissive or specular surfaces, also emission
// and specular lobe.
#define GRID_CELL_WORDS 3u
#define EXTENDED_CELL_WORDS 6u

VOXRAY_SHARED_BEGIN

// Sizes and layout. In HybridLeaves::header they follow the addresses of the arrays.
struct HybridShape {
    uint leaves;            // One for each surface voxel, in their order.
    uint capacity;          // Maximum triangles of a list.
    uint gridResolution;    // m: cells along an edge of a grid's finest level.
    uint gridLevels;        // Levels of a grid; 1: the finest only.
    uint wordsPerGrid;      // Occupancy words of a grid, all levels.
    uint cellWords;         // GRID_CELL_WORDS or EXTENDED_CELL_WORDS.
    float largestEmission;  // Largest channel of any surface's emission, W/(m² sr).
};

// The surface that a ray starts from, and the ray's footprint (a ray cone: Akenine-Möller et al. 2019). All 0
// for neither.
struct RayStart {
    vec3 normal;   // Unit length, on the ray's side: grid cells that its plane intersects are skipped. 0: no
                   // surface.
    float width;   // Of the footprint at the origin, m.
    float spread;  // Growth of the width per unit of t.
};

VOXRAY_SHARED_END

#endif
