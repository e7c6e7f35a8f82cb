// What leaves of a hybrid octree hold, shared by C++ (passes/hybrid_leaves/hybrid_leaves.h) and GLSL
// (passes/hybrid_leaves/hybrid_leaves.glsl).
#ifndef VOXRAY_HYBRID_TYPES_H
#define VOXRAY_HYBRID_TYPES_H

#include "shaders/shared/types.h"

// A leaf's word: nothing; or the number of its list's first item, with LIST_HAS_GROUPS where the list is
// long; or, with LEAF_IS_GRID, its grid's number.
#define LEAF_EMPTY 0xffffffffu
#define LEAF_IS_GRID 0x80000000u
#define LIST_HAS_GROUPS 0x40000000u
// An item of a list has two words: a triangle's box in the leaf (passes/hybrid_leaves/leaf_box.glsl), with
// this bit in the last one of a list; and its number.
#define LIST_ENDS 0x80000000u
#define LIST_ITEM_WORDS 2u
// A list of more than LIST_GROUP triangles goes in groups of so many. Before each stands an item with the box
// around all of them, by which a ray passes over them at once; LIST_ENDS marks that of the last group, too.
#define LIST_GROUP 3u
// Items of a list of so many triangles.
#define LIST_ITEMS(triangles) \
    ((triangles) + ((triangles) > LIST_GROUP ? ((triangles) + LIST_GROUP - 1u) / LIST_GROUP : 0u))
// Boxes are told in so many steps along a leaf's edge, and reach so far beyond, in voxels: what rounding may
// do to rays and triangles.
#define LEAF_BOX_STEPS 32
#define LEAF_BOX_MARGIN 0.015625

// Hit::triangle of a ray through hybrid leaves: a triangle's number; or, with this bit, the number of a
// grid's cell, whose edge in m is Hit::u; or NO_HIT; or HIT_IS_WIDE, where the ray has become wider than it
// may, at Hit::t.
#define HIT_IS_CELL 0x80000000u
#define HIT_IS_WIDE 0xfffffffeu

// A grid has levels of cells: the finest with m cells along an edge, each other one with half as many,
// rounded up, of twice the edge.
#define GRID_EDGE(m, level) (((m) + (1u << (level)) - 1u) >> (level))

// Words of a grid's cell: its plane and its albedo; then, where the scene has such surfaces, what they emit
// and their specular lobe.
#define GRID_CELL_WORDS 3u
#define BRIGHT_CELL_WORDS 6u

VOXRAY_SHARED_BEGIN

// Where the arrays are is told by their addresses, before this one (HybridLeaves::header).
struct HybridShape {
    uint leaves;            // As many as surface voxels, and in their order.
    uint capacity;          // Triangles of a list, at most.
    uint gridResolution;    // Cells along an edge of a leaf's grid.
    uint gridLevels;        // Of cells; 1: the finest alone.
    uint wordsPerGrid;      // Bits of a grid's cells of all levels, in words.
    uint cellWords;         // GRID_CELL_WORDS or BRIGHT_CELL_WORDS.
    float largestEmission;  // W/(m² sr): the largest channel that any surface emits.
};

// What a ray leaves behind: the surface, and how wide it is. All 0 for a bare ray.
struct RayStart {
    vec3 normal;   // Unit length, on the ray's side: of grids, cells that its plane touches are passed over.
                   // 0: no surface.
    float width;   // m, at the origin.
    float spread;  // Growth of the width for each unit of t.
};

VOXRAY_SHARED_END

#endif
