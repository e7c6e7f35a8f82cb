// Measures how far surfaces reach from the plane of their cell, at all levels, by an upper bound for each triangle in
// the cell: the half thickness of the slab that encloses them.
#include "passes/hybrid_leaves/build_hybrid_leaves/cell_surface.glsl"

// Upper bound of a triangle's distance from the plane of cell `c` within a finest cell that is or is in c, in edges of
// c. The least of three: by the triangle's corners; by its centroid in the finest cell, plus its rise over that cell's
// diagonal; by that cell's corners. `center`: of the finest cell relative to c; `scale`: its edge; both in edges of c.
float halfThicknessBound(GridCell c, CellSurface s, TriangleFragment cell, vec3 center, float scale) {
    const GridTriangle t = cell.permutedTriangle;
    float cornerBound = 0.0;
    const vec3 points[] = vec3[](t.p0, t.p1, t.p2);
    for (uint k = 0u; k < 3u; ++k)
        cornerBound =
            max(cornerBound, abs(dot(c.normal, center + scale * fromCellCenter(cell, points[k])) - c.distance_));
    const vec3 n = s.material.point.geometricNormal;
    const float slope = n == vec3(0.0) ? 1.0 : length(cross(c.normal, n));
    const float slopeBound = abs(dot(c.normal, center + scale * s.point) - c.distance_) + slope * sqrt(3.0) * scale;
    return min(min(cornerBound, slopeBound),
               abs(dot(c.normal, center) - c.distance_) + 0.5 * scale * dot(abs(c.normal), vec3(1.0)));
}

void processFragment(TriangleFragment cell) {
    CellSurface s;
    if (!cellSurface(cell, s)) return;
    for (uint level = 0u; level < hybridLeaves.shape.gridLevels; ++level) {
        const ivec3 ancestor = cell.voxel >> level;
        const uint cellIndex = level == 0u ? s.cellIndex : gridCellIndex(gridBit(gridLevel(cellGrid, level), ancestor));
        const float scale = 1.0 / float(1u << level);
        const vec3 center = (vec3(cell.voxel) + 0.5) * scale - (vec3(ancestor) + 0.5);
        thickenGridCell(cellIndex, halfThicknessBound(gridCell(cellIndex), s, cell, center, scale));
    }
}
