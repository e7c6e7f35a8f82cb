// What a triangle's fragment in a cell is made of.
#ifndef VOXRAY_CELL_SURFACE_GLSL
#define VOXRAY_CELL_SURFACE_GLSL

#include "passes/build_hybrid_leaves/grid_cells.glsl"
#include "passes/common/voxel_builder/fragment_material.glsl"
#include "shaders/hybrid_leaves/grid_cell.glsl"

// Its centroid from the cell's center, in cells. @param center as barycentric coordinates
vec3 meanPoint(TriangleFragment cell, vec2 center) {
    const GridTriangle t = cell.permutedTriangle;
    const vec3 point = t.p0 + center.x * (t.p1 - t.p0) + center.y * (t.p2 - t.p0) - (vec3(cell.permutedVoxel) + 0.5);
    return clamp(t.axis == 0u ? point.zxy : t.axis == 1u ? point.yzx : point, -0.5, 0.5);
}

#endif
