// Area and centroid of a triangle clipped to a voxel, in closed form: integrals along the boundary.
#ifndef VOXRAY_CLIPPED_AREA_GLSL
#define VOXRAY_CLIPPED_AREA_GLSL

#include "passes/common/triangle_voxelizer/grid_triangle.glsl"

// Integrals of 1, x and y over the area below the segment from a to b, where y is from 0 to 1 at both.
vec3 trapezoid(vec2 a, vec2 b) {
    const vec3 sums =
        vec3(3.0 * (a.y + b.y), a.x * (2.0 * a.y + b.y) + b.x * (a.y + 2.0 * b.y), a.y * a.y + a.y * b.y + b.y * b.y);
    return (b.x - a.x) / 6.0 * sums;
}

// The same integrals over the part of the unit square below a segment, signed by the segment's direction along x. Their
// sum over a closed polygon is that over the polygon clipped to the square, with no special case for edges that cross
// the square's border.
vec3 squareBelow(vec2 a, vec2 b) {
    const float x0 = clamp(a.x, 0.0, 1.0), x1 = clamp(b.x, 0.0, 1.0);
    if (x0 == x1) return vec3(0.0);
    const vec2 from = vec2(x0, mix(a.y, b.y, (x0 - a.x) / (b.x - a.x)));
    const vec2 to = vec2(x1, mix(a.y, b.y, (x1 - a.x) / (b.x - a.x)));
    // Three segments: y is clamped before the first crossing of 0 or 1 and after the second.
    const float rise = to.y - from.y;
    const vec2 crossings = rise == 0.0 ? vec2(0.0, 1.0) : clamp((vec2(0.0, 1.0) - from.y) / rise, 0.0, 1.0);
    const float y0 = clamp(from.y, 0.0, 1.0), y1 = clamp(to.y, 0.0, 1.0);
    const vec2 first = vec2(mix(from.x, to.x, min(crossings.x, crossings.y)), y0);
    const vec2 second = vec2(mix(from.x, to.x, max(crossings.x, crossings.y)), y1);
    return trapezoid(vec2(from.x, y0), first) + trapezoid(first, second) + trapezoid(second, vec2(to.x, y1));
}

// Area (voxel faces) of a triangle clipped to a voxel, and its centroid over x and y. A voxel owns its lower face, so
// that a triangle between two voxels counts once. If nothing is left, `center` is that of the voxel's column.
float clippedArea(GridTriangle t, ivec3 voxel, out vec2 center) {
    const vec3 corner = vec3(voxel);
    if (all(greaterThanEqual(t.lower, corner)) && all(lessThan(t.upper, corner + 1.0))) {
        center = (t.p0.xy + t.p1.xy + t.p2.xy) / 3.0;
        return t.area;
    }

    // The outline of the triangle between the voxel's lower and upper face: its clipped edges, and segments along the
    // faces that close it.
    vec3 sums = vec3(0.0);
    vec4 exits = vec4(0.0), entries = vec4(0.0);  // Of the edges, over the lower face (xy) and the upper one (zw).
    vec3 a = t.p2 - corner;
    for (int k = 0; k < 3; ++k) {
        const vec3 b = (k == 0 ? t.p0 : k == 1 ? t.p1 : t.p2) - corner;
        const bvec2 insideA = bvec2(a.z >= 0.0, a.z < 1.0), insideB = bvec2(b.z >= 0.0, b.z < 1.0);
        const vec2 lower = mix(a.xy, b.xy, insideA.x == insideB.x ? 0.0 : a.z / (a.z - b.z));
        const vec2 upper = mix(a.xy, b.xy, insideA.y == insideB.y ? 0.0 : (a.z - 1.0) / (a.z - b.z));
        if (insideA.x && !insideB.x) exits.xy = lower;
        if (insideB.x && !insideA.x) entries.xy = lower;
        if (insideA.y && !insideB.y) exits.zw = upper;
        if (insideB.y && !insideA.y) entries.zw = upper;
        if ((insideA.x || insideB.x) && (insideA.y || insideB.y))
            sums += squareBelow(!insideA.x ? lower : !insideA.y ? upper : a.xy,
                                !insideB.x ? lower : !insideB.y ? upper : b.xy);
        a = b;
    }
    sums += squareBelow(exits.xy, entries.xy) + squareBelow(exits.zw, entries.zw);
    center = corner.xy + (sums.x != 0.0 ? clamp(sums.yz / sums.x, 0.0, 1.0) : vec2(0.5));
    return abs(sums.x / t.normal.z);
}

#endif
