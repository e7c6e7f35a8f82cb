// Fragment callback: counts the triangles of each leaf, nearly transparent ones included, since rays may hit what the
// alpha mask leaves.
#ifndef VOXRAY_COUNT_TRIANGLES_GLSL
#define VOXRAY_COUNT_TRIANGLES_GLSL

#include "passes/hybrid_leaves/build_hybrid_leaves/is_listed.glsl"
#include "shaders/voxels/voxels.glsl"

buffer Counts { uint triangles[]; } counts;  // By leaf.

void processFragment(TriangleFragment f) {
    const uint leaf = voxelNumber(voxelizer.grid, f.voxel);
    if (leaf != NO_VOXEL && isListed(f)) atomicAdd(counts.triangles[leaf], 1u);
}

#endif
