// Which pairs of a triangle and a leaf count.
#ifndef VOXRAY_LISTED_GLSL
#define VOXRAY_LISTED_GLSL

#include "passes/common/triangle_walk/exact.glsl"

// With FRAGMENTS those of which a raster pass along the axis that the triangle faces most makes a fragment: where the center of the
// voxel's column lies in the triangle, and the triangle's depth there in the voxel. What is thinner than the distance of centers, or
// passes a second voxel of a column, is missed (Seok 2021, figure 24).
bool isListed(TriangleFragment f) {
#ifdef FRAGMENTS
    const GridTriangle t = f.permutedTriangle;
    const vec2 center = vec2(f.permutedVoxel.xy) + 0.5;
    return owns(t.p0.xy, t.p1.xy, t.winding.z, center) && owns(t.p1.xy, t.p2.xy, t.winding.z, center) &&
           owns(t.p2.xy, t.p0.xy, t.winding.z, center) && int(floor(depthAt(t, center))) == f.permutedVoxel.z;
#else
    return true;
#endif
}

#endif
