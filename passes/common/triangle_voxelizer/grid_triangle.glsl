// A triangle in grid coordinates and the voxels that it overlaps: separating axes as a plane and three projections,
// after Schwarz and Seidel 2010, section 4.
#ifndef VOXRAY_GRID_TRIANGLE_GLSL
#define VOXRAY_GRID_TRIANGLE_GLSL

#include "shaders/scene/scene.glsl"
#include "shaders/voxels/voxel_types.h"

// Voxels are closed boxes, enlarged by this on each side: grid coordinates up to 1024 are exact to 2^-14.
const float kMargin = 1.0 / 4096.0;

// Coordinates are in voxels and permuted: z runs along the triangle's dominant axis, x and y along the next two axes in
// cyclic order.
struct GridTriangle {
    uint index;
    uint axis;
    vec3 p0, p1, p2;
    vec3 lower, upper;  // Bounds.
    vec3 normal;        // Unit length, front side.
    vec3 winding;       // Signs of the normal; 0 where the triangle is edge-on within rounding.
    vec2 slope;         // Of z over x and y.
    float area;         // In voxel faces; 0 below rounding: such triangles have no voxels.
    vec2 texCoordWidth;  // log2 of a voxel's width in texture coordinates 0 and 1: the mean of both directions.
    float planeError;   // Bound of the rounding error of z on the plane; relevant for slivers alone.
};

vec3 permuted(vec3 v, uint axis) { return axis == 0u ? v.yzx : axis == 1u ? v.zxy : v; }
uvec3 permutedVoxels(uvec3 v, uint axis) { return axis == 0u ? v.yzx : axis == 1u ? v.zxy : v; }
ivec3 unpermuted(ivec3 v, uint axis) { return axis == 0u ? v.zxy : axis == 1u ? v.yzx : v; }

vec3 gridVertex(VoxelGrid g, uint vertex) { return (vertexPosition(vertex) - g.origin) / g.voxelSize; }

uint dominantAxis(vec3 normal) {
    const vec3 n = abs(normal);
    return n.x > n.y ? (n.x > n.z ? 0u : 2u) : (n.y > n.z ? 1u : 2u);
}

// log2 of a voxel's width in a triangle's texture coordinates. @param area of the triangle, in voxel faces
vec2 texCoordWidth(uvec3 vertices, float area) {
    const vec4 origin = vertexAttributes(vertices.x).texCoords;
    const vec4 a = vertexAttributes(vertices.y).texCoords - origin;
    const vec4 b = vertexAttributes(vertices.z).texCoords - origin;
    const vec2 twiceArea = abs(vec2(a.x * b.y - a.y * b.x, a.z * b.w - a.w * b.z));
    return 0.5 * log2(max(0.5 * twiceArea / max(area, 1.0e-30), 1.0e-30));
}

GridTriangle gridTriangle(VoxelGrid g, uint index, uint axis) {
    const uvec3 v = triangleVertices(index);
    GridTriangle t;
    t.index = index;
    t.axis = axis;
    t.p0 = permuted(gridVertex(g, v.x), axis);
    t.p1 = permuted(gridVertex(g, v.y), axis);
    t.p2 = permuted(gridVertex(g, v.z), axis);
    t.lower = min(t.p0, min(t.p1, t.p2));
    t.upper = max(t.p0, max(t.p1, t.p2));
    const vec3 e1 = t.p1 - t.p0, e2 = t.p2 - t.p0, cross_ = cross(e1, e2);
    const float twiceArea = length(cross_);
    const float rounding = 4.0e-7 * length(e1) * length(e2);
    const bool flat_ = twiceArea > 4.0 * rounding && abs(cross_.z) > rounding;
    t.area = flat_ ? 0.5 * twiceArea : 0.0;
    t.normal = flat_ ? cross_ / twiceArea : vec3(0.0, 0.0, 1.0);
    t.winding = mix(sign(cross_), vec3(0.0), lessThanEqual(abs(cross_), vec3(rounding)));
    t.slope = -t.normal.xy / t.normal.z;
    t.texCoordWidth = texCoordWidth(v, t.area);
    t.planeError = flat_ ? rounding / twiceArea * max(length(e1), length(e2)) : 0.0;
    return t;
}

float depthAt(GridTriangle t, vec2 xy) { return t.p0.z + dot(t.slope, xy - t.p0.xy); }

// Whether the unit square at `corner` reaches the inner side of a projected edge.
bool overlapsHalfPlane(vec2 a, vec2 b, float winding, vec2 corner, float margin) {
    const vec2 inward = winding * vec2(a.y - b.y, b.x - a.x);
    const vec2 farthest = corner + vec2(greaterThan(inward, vec2(0.0)));
    return dot(inward, farthest - a) >= -margin * (abs(inward.x) + abs(inward.y));
}

bool overlapsSquare(vec2 a, vec2 b, vec2 c, float winding, vec2 corner, float margin) {
    return overlapsHalfPlane(a, b, winding, corner, margin) && overlapsHalfPlane(b, c, winding, corner, margin) &&
           overlapsHalfPlane(c, a, winding, corner, margin);
}

// The first and last columns of voxels along z that the triangle's bounds overlap.
ivec4 columnRange(GridTriangle t, float margin, ivec2 resolution) {
    return ivec4(clamp(floor(t.lower.xy - margin), vec2(0.0), vec2(resolution)),
                 clamp(floor(t.upper.xy + margin), vec2(-1.0), vec2(resolution) - 1.0));
}

bool overlapsColumn(GridTriangle t, ivec2 column, float margin) {
    return overlapsSquare(t.p0.xy, t.p1.xy, t.p2.xy, t.winding.z, vec2(column), margin);
}

// The first and last voxels of a column that the triangle's plane passes through, within the triangle's bounds.
ivec2 depthRange(GridTriangle t, ivec2 column, float margin, int resolution) {
    const float center = depthAt(t, vec2(column) + 0.5);
    const float reach = 0.5 * (abs(t.slope.x) + abs(t.slope.y)) + margin + t.planeError;
    const float from = max(center - reach, t.lower.z - margin), to = min(center + reach, t.upper.z + margin);
    const float end = float(resolution);
    return ivec2(clamp(floor(from), 0.0, end), clamp(floor(to), -1.0, end - 1.0));
}

// The remaining two projections, for a voxel that passes columnRange, overlapsColumn and depthRange.
bool overlapsVoxel(GridTriangle t, ivec3 voxel, float margin) {
    const vec3 corner = vec3(voxel);
    return overlapsSquare(t.p0.yz, t.p1.yz, t.p2.yz, t.winding.x, corner.yz, margin) &&
           overlapsSquare(t.p0.zx, t.p1.zx, t.p2.zx, t.winding.y, corner.zx, margin);
}

// Barycentric coordinates of the triangle's point over xy, clamped to the triangle.
vec2 barycentricsAt(GridTriangle t, vec2 xy) {
    const vec2 e1 = t.p1.xy - t.p0.xy, e2 = t.p2.xy - t.p0.xy, d = xy - t.p0.xy;
    const float determinant = e1.x * e2.y - e1.y * e2.x;
    vec3 w;
    w.y = (d.x * e2.y - d.y * e2.x) / determinant;
    w.z = (e1.x * d.y - e1.y * d.x) / determinant;
    w.x = 1.0 - w.y - w.z;
    w = max(w, 0.0);
    return w.yz / (w.x + w.y + w.z);
}

#endif
