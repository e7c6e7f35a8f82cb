// How far from the plane of its cell each triangle's part in the cell lies, at all levels: what encloses all surfaces of a cell is the
// largest.
#include "passes/hybrid_leaves/build_hybrid_leaves/cell_surface.glsl"

// Bounds of the distance from the plane of a cell `c`, which is the finest cell or holds it, in edges of c: that of the triangle's
// corners; that of the part's centroid, and what the triangle rises over the length of the finest cell's diagonal; that of the finest
// cell's corners. `center`: of the finest cell from that of c, in edges of c; `scale`: the finest cell's edge in these.
float reachOf(GridCell c, CellSurface s, TriangleFragment cell, vec3 center, float scale) {
    const GridTriangle t = cell.permutedTriangle;
    float corners = 0.0;
    const vec3 points[] = vec3[](t.p0, t.p1, t.p2);
    for (uint k = 0u; k < 3u; ++k)
        corners = max(corners, abs(dot(c.normal, center + scale * fromCellCenter(cell, points[k])) - c.distance_));
    const vec3 n = s.material.at.geometricNormal;
    const float slope = n == vec3(0.0) ? 1.0 : length(cross(c.normal, n));
    const float risen = abs(dot(c.normal, center + scale * s.point) - c.distance_) + slope * sqrt(3.0) * scale;
    return min(min(corners, risen), abs(dot(c.normal, center) - c.distance_) + 0.5 * scale * dot(abs(c.normal), vec3(1.0)));
}

void visitFragment(TriangleFragment cell) {
    CellSurface s;
    if (!cellSurface(cell, s)) return;
    for (uint level = 0u; level < hybridLeaves.shape.gridLevels; ++level) {
        const ivec3 at = cell.voxel >> level;
        const uint number = level == 0u ? s.number : gridCellNumber(gridBit(gridLevel(cellGrid, level), at));
        const float scale = 1.0 / float(1u << level);
        const vec3 center = (vec3(cell.voxel) + 0.5) * scale - (vec3(at) + 0.5);
        widenGridCell(number, reachOf(gridCell(number), s, cell, center, scale));
    }
}
