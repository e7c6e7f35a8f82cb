// Which pairs of a triangle and a voxel are listed.
#ifndef VOXRAY_IS_LISTED_GLSL
#define VOXRAY_IS_LISTED_GLSL

#include "passes/common/triangle_voxelizer/clipped_fragment.glsl"

// With ONE_VOXEL_PER_FRAGMENT one voxel of each column that the triangle overlaps, as a raster fragment has one depth:
// that of the triangle's plane at the column's center, within the triangle's bounds. Where the triangle passes through
// more voxels of the column, it is missing in the others (Seok 2021, figure 24).
bool isListed(TriangleFragment f) {
#ifdef ONE_VOXEL_PER_FRAGMENT
    const GridTriangle t = f.permutedTriangle;
    const float depth = clamp(depthAt(t, vec2(f.permutedVoxel.xy) + 0.5), t.lower.z, t.upper.z);
    return int(floor(depth)) == f.permutedVoxel.z;
#else
    return true;
#endif
}

#endif
