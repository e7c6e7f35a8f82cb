// Coverage masks: the sub-samples of a voxel's faces that a triangle covers within the voxel.
#ifndef VOXRAY_SUB_SAMPLES_GLSL
#define VOXRAY_SUB_SAMPLES_GLSL

#include "passes/common/triangle_voxelizer/grid_triangle.glsl"

// Sub-samples of a voxel's face: 4x4, a bit each.
const int kSide = 4;
const float kSubSamples = 16.0;
const uint CENTER = 1u << 16;  // A bit after those of the sub-samples: the center of the face.

// Whether a point is on the inner side of an edge. Points on the edge belong to one of the two triangles that share it
// (fill rule).
bool isInsideEdge(vec2 a, vec2 b, float winding, vec2 point) {
    const vec2 inward = winding * vec2(a.y - b.y, b.x - a.x);
    const float distance_ = dot(inward, point - a);
    return distance_ > 0.0 || (distance_ == 0.0 && (inward.y > 0.0 || (inward.y == 0.0 && inward.x > 0.0)));
}

// The sub-samples of the voxel's face across z whose lines along z hit the triangle within the voxel. For another axis,
// permute all vectors.
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
            if (!isInsideEdge(p0.xy, p1.xy, winding, point) || !isInsideEdge(p1.xy, p2.xy, winding, point) ||
                !isInsideEdge(p2.xy, p0.xy, winding, point))
                continue;
            const float depth = p0.z - dot(normal.xy, point - p0.xy) / normal.z;
            if (int(floor(depth)) == voxel.z) mask |= 1u << uint(y * kSide + x);
        }
    return mask;
}

// Sub-samples of the face across the triangle's dominant axis.
uint dominantAxisSubSamples(GridTriangle t, ivec3 voxel) {
    return subSamples(t.p0, t.p1, t.p2, t.normal, t.winding.z, voxel);
}

// Sub-samples of the faces across the other two axes, by world axis.
uvec3 otherAxesSubSamples(GridTriangle t, ivec3 voxel) {
    uvec3 byAxis = uvec3(0u);
    for (uint k = 1u; k < 3u; ++k) {
        t.p0 = t.p0.yzx;
        t.p1 = t.p1.yzx;
        t.p2 = t.p2.yzx;
        t.normal = t.normal.yzx;
        t.winding = t.winding.yzx;
        voxel = voxel.yzx;
        byAxis[(t.axis + k) % 3u] = subSamples(t.p0, t.p1, t.p2, t.normal, t.winding.z, voxel);
    }
    return byAxis;
}

vec2 subSamplePoint(ivec3 voxel, int bit) {
    if (bit == 16) return vec2(voxel.xy) + 0.5;
    return vec2(voxel.xy) + (vec2(bit % kSide, bit / kSide) + 0.5) / float(kSide);
}

// The sub-samples of `mask` that pass the material's alpha mask.
uint opaqueSubSamples(GridTriangle t, GpuMaterial m, ivec3 voxel, uint mask) {
    uint opaque = 0u;
    for (uint rest = mask; rest != 0u; rest &= rest - 1u) {
        const int bit = findLSB(rest);
        if (!alphaCut(m, surfacePoint(t.index, barycentricsAt(t, subSamplePoint(voxel, bit)))))
            opaque |= 1u << uint(bit);
    }
    return opaque;
}

#endif
