#version 460
#extension GL_GOOGLE_include_directive : require
// How far from the plane of its cell each triangle's part in the cell lies: what encloses all surfaces of a cell is the largest.
#include "passes/build_hybrid_leaves/cell_surface.glsl"

// Bounds of the distance from the plane, in cells: that of the triangle's corners; that of the part's centroid, and what the triangle
// rises over the length of a cell's diagonal; that of the cell's corners.
float reachOf(GridCell c, CellSurface s, TriangleFragment cell) {
    const GridTriangle t = cell.permutedTriangle;
    float corners = 0.0;
    const vec3 points[] = vec3[](t.p0, t.p1, t.p2);
    for (uint k = 0u; k < 3u; ++k) corners = max(corners, abs(dot(c.normal, fromCellCenter(cell, points[k])) - c.distance_));
    const float slope = length(cross(c.normal, s.material.at.geometricNormal));
    const float risen = abs(dot(c.normal, s.point) - c.distance_) + (s.material.at.geometricNormal == vec3(0.0) ? 1.0 : slope) * sqrt(3.0);
    return min(min(corners, risen), abs(c.distance_) + 0.5 * dot(abs(c.normal), vec3(1.0)));
}

void visitFragment(TriangleFragment cell) {
    CellSurface s;
    if (!cellSurface(cell, s)) return;
    widenGridCell(s.number, reachOf(gridCell(s.number), s, cell));
}
