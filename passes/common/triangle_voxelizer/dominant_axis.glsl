// A pixel is a column of voxels that the triangle touches. It yields all voxels that the triangle's plane passes
// through there. Entry point of fragment shaders that define processFragment().
#include "passes/common/triangle_voxelizer/clipped_fragment.glsl"
#include "passes/common/triangle_voxelizer/voxelizer_push.glsl"

layout(location = 0) flat in uint triangle;
layout(location = 1) flat in uint axis;

// Twice the margin of `exact`: its voxels are among these, whatever rounding does.
const float kRasterMargin = 2.0 * kMargin;

#ifdef MULTISAMPLED
// The voxel's share of the area of the column, in voxel faces seen along z: of the pixel's covered samples, divided over
// voxels by their sub-samples. On average it is the area, since pixels without a covered sample have no fragment.
float projectedArea(GridTriangle t, ivec3 permutedVoxel, uint subSamples) {
    const ivec2 depths =
        depthRange(t, permutedVoxel.xy, kRasterMargin, int(permutedVoxels(voxelizer.grid.resolution, axis).z));
    uint inColumn = 0u;
    for (int z = depths.x; z <= depths.y; ++z)
        inColumn += bitCount(dominantAxisSubSamples(t, ivec3(permutedVoxel.xy, z)));
    const float share =
        inColumn > 0u ? float(bitCount(subSamples)) / float(inColumn) : 1.0 / float(depths.y - depths.x + 1);
    return share * float(bitCount(uint(gl_SampleMaskIn[0]))) / float(voxelizer.samples);
}
#else
float projectedArea(GridTriangle t, ivec3 permutedVoxel, uint subSamples) {
    return float(bitCount(subSamples)) / kSubSamples;
}
#endif

// Area by samples, and the sub-samples' centroid, or the center of the column where there are none.
float measureFragment(GridTriangle t, ivec3 permutedVoxel, uint subSamples, out vec2 center) {
    center = vec2(permutedVoxel.xy) + 0.5;
    if (subSamples != 0u) {
        center = vec2(0.0);
        for (uint rest = subSamples; rest != 0u; rest &= rest - 1u)
            center += subSamplePoint(permutedVoxel, findLSB(rest));
        center /= float(bitCount(subSamples));
    }
    return projectedArea(t, permutedVoxel, subSamples) / abs(t.normal.z);
}

void main() {
    const GridTriangle t = gridTriangle(voxelizer.grid, triangle, axis);
    const ivec3 resolution = ivec3(permutedVoxels(voxelizer.grid.resolution, axis));
    const ivec2 column = ivec2(permutedVoxels(uvec3(voxelizer.grid.first), axis).xy) + ivec2(gl_FragCoord.xy);
    const ivec4 range = columnRange(t, kRasterMargin, resolution.xy);
    if (any(lessThan(column, range.xy)) || any(greaterThan(column, range.zw))) return;
    if (!overlapsColumn(t, column, kRasterMargin)) return;
    const ivec2 depths = depthRange(t, column, kRasterMargin, resolution.z);
    for (int z = depths.x; z <= depths.y; ++z) processFragment(triangleFragment(t, ivec3(column, z)));
}
