// The piece of a triangle that lies in one voxel: its area, its centroid and the sub-samples that it covers.
#ifndef VOXRAY_PIECE_GLSL
#define VOXRAY_PIECE_GLSL

#include "passes/voxelize/grid_triangle.glsl"

// Sub-samples of a voxel's face: 4x4, a bit each.
const int kSide = 4;
const float kSubSamples = 16.0;

// Whether a point is on the inner side of an edge; of two triangles that share the edge, one owns it.
bool owns(vec2 a, vec2 b, float winding, vec2 point) {
    const vec2 inward = winding * vec2(a.y - b.y, b.x - a.x);
    const float side = dot(inward, point - a);
    return side > 0.0 || (side == 0.0 && (inward.y > 0.0 || (inward.y == 0.0 && inward.x > 0.0)));
}

// The sub-samples of the voxel's face across z whose lines along z meet the triangle within the voxel. To look along another
// axis, turn all vectors.
uint subSamples(vec3 p0, vec3 p1, vec3 p2, vec3 normal, float winding, ivec3 voxel) {
    if (winding == 0.0) return 0u;
    const vec2 corner = vec2(voxel.xy);
    const vec2 lower = (min(p0.xy, min(p1.xy, p2.xy)) - corner) * float(kSide) - 0.5;
    const vec2 upper = (max(p0.xy, max(p1.xy, p2.xy)) - corner) * float(kSide) - 0.5;
    const ivec2 first = ivec2(clamp(ceil(lower), 0.0, float(kSide)));
    const ivec2 last = ivec2(clamp(floor(upper), -1.0, float(kSide - 1)));
    uint mask = 0u;
    for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x) {
            const vec2 point = corner + (vec2(x, y) + 0.5) / float(kSide);
            if (!owns(p0.xy, p1.xy, winding, point) || !owns(p1.xy, p2.xy, winding, point) ||
                !owns(p2.xy, p0.xy, winding, point))
                continue;
            const float depth = p0.z - dot(normal.xy, point - p0.xy) / normal.z;
            if (int(floor(depth)) == voxel.z) mask |= 1u << uint(y * kSide + x);
        }
    return mask;
}

// Sub-samples seen along the triangle's own z.
uint ownSubSamples(GridTriangle t, ivec3 voxel) {
    return subSamples(t.p0, t.p1, t.p2, t.normal, t.winding.z, voxel);
}

// Sub-samples by world axis, the triangle's own given.
uvec3 allSubSamples(GridTriangle t, ivec3 voxel, uint own) {
    const uint x = subSamples(t.p0.yzx, t.p1.yzx, t.p2.yzx, t.normal.yzx, t.winding.x, voxel.yzx);
    const uint y = subSamples(t.p0.zxy, t.p1.zxy, t.p2.zxy, t.normal.zxy, t.winding.y, voxel.zxy);
    return t.axis == 0u ? uvec3(own, x, y) : t.axis == 1u ? uvec3(y, own, x) : uvec3(x, y, own);
}

vec2 subSamplePoint(ivec3 voxel, int bit) {
    return vec2(voxel.xy) + (vec2(bit % kSide, bit / kSide) + 0.5) / float(kSide);
}

// Those of the sub-samples in `mask` that the material's alpha mask leaves.
uint alphaLeaves(GridTriangle t, GpuMaterial m, ivec3 voxel, uint mask) {
    uint left = 0u;
    for (uint rest = mask; rest != 0u; rest &= rest - 1u) {
        const int bit = findLSB(rest);
        if (!alphaCut(m, surfacePoint(t.index, barycentricsAt(t, subSamplePoint(voxel, bit))))) left |= 1u << uint(bit);
    }
    return left;
}

// The part of a piece that its alpha mask leaves, 0 to 1: of its own sub-samples or, where there are none, of the point
// nearest to the middle of the voxel's column.
float alphaShare(GridTriangle t, GpuMaterial m, ivec3 voxel, uint own) {
    if (m.alphaMode != ALPHA_MASK) return 1.0;
    if (own == 0u) return alphaCut(m, surfacePoint(t.index, barycentricsAt(t, vec2(voxel.xy) + 0.5))) ? 0.0 : 1.0;
    return float(bitCount(alphaLeaves(t, m, voxel, own))) / float(bitCount(own));
}

// Cuts a convex polygon by the half-plane h.x x + h.y y + h.z >= 0, or > 0 where it is open (Sutherland and Hodgman 1974).
void cut(inout vec2 polygon[9], inout int count, vec3 h, bool open) {
    vec2 kept[9];
    int n = 0;
    vec2 a = polygon[max(count - 1, 0)];
    float da = dot(h.xy, a) + h.z;
    bool insideA = open ? da > 0.0 : da >= 0.0;
    for (int i = 0; i < count; ++i) {
        const vec2 b = polygon[i];
        const float db = dot(h.xy, b) + h.z;
        const bool insideB = open ? db > 0.0 : db >= 0.0;
        if (insideA != insideB && n < 9) kept[n++] = mix(a, b, da / (da - db));
        if (insideB && n < 9) kept[n++] = b;
        a = b;
        da = db;
        insideA = insideB;
    }
    polygon = kept;
    count = n;
}

// Area, in voxel faces, of the part of the triangle in a voxel, and its centroid over x and y. A voxel owns its lower faces, so
// that a triangle that lies in a face counts once; where nothing is left, the middle of the voxel's column.
float clippedArea(GridTriangle t, ivec3 voxel, out vec2 middle) {
    const vec3 corner = vec3(voxel);
    if (all(greaterThanEqual(t.lower, corner)) && all(lessThan(t.upper, corner + 1.0))) {
        middle = (t.p0.xy + t.p1.xy + t.p2.xy) / 3.0;
        return t.area;
    }
    middle = corner.xy + 0.5;
    vec2 polygon[9];
    polygon[0] = t.p0.xy - corner.xy;
    polygon[1] = t.p1.xy - corner.xy;
    polygon[2] = t.p2.xy - corner.xy;
    int count = 3;
    const vec3 depth = vec3(t.slope, depthAt(t, corner.xy) - corner.z);
    if (t.lower.x < corner.x) cut(polygon, count, vec3(1.0, 0.0, 0.0), false);
    if (t.upper.x >= corner.x + 1.0) cut(polygon, count, vec3(-1.0, 0.0, 1.0), true);
    if (t.lower.y < corner.y) cut(polygon, count, vec3(0.0, 1.0, 0.0), false);
    if (t.upper.y >= corner.y + 1.0) cut(polygon, count, vec3(0.0, -1.0, 1.0), true);
    if (t.lower.z < corner.z) cut(polygon, count, depth, false);
    if (t.upper.z >= corner.z + 1.0) cut(polygon, count, vec3(-depth.xy, 1.0 - depth.z), true);

    // Area and centroid as sums over a fan of triangles.
    float twice = 0.0;
    vec2 moment = vec2(0.0);
    for (int i = 2; i < count; ++i) {
        const vec2 e1 = polygon[i - 1] - polygon[0], e2 = polygon[i] - polygon[0];
        const float part = e1.x * e2.y - e1.y * e2.x;
        twice += part;
        moment += part * (e1 + e2) / 3.0;
    }
    if (twice != 0.0) middle = corner.xy + polygon[0] + moment / twice;
    return 0.5 * abs(twice / t.normal.z);
}

#endif
