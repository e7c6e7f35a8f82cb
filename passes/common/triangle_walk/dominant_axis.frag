#version 460
#extension GL_GOOGLE_include_directive : require
// One fragment: a column of voxels that the grown triangle touches. It reaches every voxel that the triangle's plane passes
// through there, so that none is missed.
#include "passes/common/triangle_walk/visit.glsl"

layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint imageSide;
    float emissionScale;
} push;

layout(location = 0) flat in uint triangle;
layout(location = 1) flat in uint axis;

#ifndef MARK
// By sub-samples; the center of those, or of the column where there are none.
float measureFragment(GridTriangle t, ivec3 voxel, uint own, out vec2 center) {
    center = vec2(voxel.xy) + 0.5;
    if (own == 0u) return 0.0;
    center = vec2(0.0);
    for (uint rest = own; rest != 0u; rest &= rest - 1u) center += subSamplePoint(voxel, findLSB(rest));
    center /= float(bitCount(own));
    return float(bitCount(own)) / (kSubSamples * abs(t.normal.z));
}
#endif

void main() {
    const GridTriangle t = gridTriangle(push.grid, triangle, axis);
    const ivec3 resolution = ivec3(permutedVoxels(push.grid.resolution, axis));
    const ivec2 column = ivec2(gl_FragCoord.xy);
    // Twice the margin of `exact`, whose voxels are a part of these whatever rounding does.
    const float margin = 2.0 * kMargin;
    const ivec4 range = columnRange(t, margin, resolution.xy);
    if (any(lessThan(column, range.xy)) || any(greaterThan(column, range.zw))) return;
    if (!overlapsColumn(t, column, margin)) return;
    const ivec2 depths = depthRange(t, column, margin, resolution.z);
    for (int z = depths.x; z <= depths.y; ++z) visit(push.grid, t, ivec3(column, z), push.emissionScale);
}
