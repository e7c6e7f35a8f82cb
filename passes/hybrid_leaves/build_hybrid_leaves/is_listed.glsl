// Which pairs of a triangle and a leaf are listed.
#ifndef VOXRAY_IS_LISTED_GLSL
#define VOXRAY_IS_LISTED_GLSL

#include "passes/common/triangle_voxelizer/exact.glsl"

// With FRAGMENTS those of which rasterization along the dominant axis makes a fragment: where the center of the voxel's
// column is in the triangle, at a depth in the voxel. Triangles between centers, and a second voxel of a column, are
// missed (Seok 2021, figure 24).
bool isListed(TriangleFragment f) {
#ifdef FRAGMENTS
    const GridTriangle t = f.permutedTriangle;
    const vec2 center = vec2(f.permutedVoxel.xy) + 0.5;
    return isInsideEdge(t.p0.xy, t.p1.xy, t.winding.z, center) && isInsideEdge(t.p1.xy, t.p2.xy, t.winding.z, center) &&
           isInsideEdge(t.p2.xy, t.p0.xy, t.winding.z, center) && int(floor(depthAt(t, center))) == f.permutedVoxel.z;
#else
    return true;
#endif
}

#endif
