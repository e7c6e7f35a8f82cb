// A pixel is a column of voxels that the triangle touches. It yields all voxels that the triangle's plane passes
// through there. Entry point of fragment shaders that define processFragment().
#include "passes/common/triangle_voxelizer/clipped_fragment.glsl"
#include "passes/common/triangle_voxelizer/voxelizer_push.glsl"

layout(location = 0) flat in uint triangle;
layout(location = 1) flat in uint axis;

// Area by sub-samples, and their centroid, or the center of the column where there are none.
float measureFragment(GridTriangle t, ivec3 permutedVoxel, uint subSamples, out vec2 center) {
    center = vec2(permutedVoxel.xy) + 0.5;
    if (subSamples == 0u) return 0.0;
    center = vec2(0.0);
    for (uint rest = subSamples; rest != 0u; rest &= rest - 1u) center += subSamplePoint(permutedVoxel, findLSB(rest));
    center /= float(bitCount(subSamples));
    return float(bitCount(subSamples)) / (kSubSamples * abs(t.normal.z));
}

void main() {
    const GridTriangle t = gridTriangle(voxelizer.grid, triangle, axis);
    const ivec3 resolution = ivec3(permutedVoxels(voxelizer.grid.resolution, axis));
    const ivec2 column = ivec2(permutedVoxels(uvec3(voxelizer.grid.first), axis).xy) + ivec2(gl_FragCoord.xy);
    // Twice the margin of `exact`: its voxels are among these, whatever rounding does.
    const float margin = 2.0 * kMargin;
    const ivec4 range = columnRange(t, margin, resolution.xy);
    if (any(lessThan(column, range.xy)) || any(greaterThan(column, range.zw))) return;
    if (!overlapsColumn(t, column, margin)) return;
    const ivec2 depths = depthRange(t, column, margin, resolution.z);
    for (int z = depths.x; z <= depths.y; ++z) processFragment(triangleFragment(t, ivec3(column, z)));
}
