// A walk's visitor: counts the triangles of each leaf, those too of which an alpha mask leaves little: a ray may meet what it leaves.
#include "passes/hybrid_leaves/build_hybrid_leaves/listed.glsl"
#include "shaders/voxels/voxels.glsl"

buffer Counts { uint triangles[]; } counts;  // By leaf.

void visitFragment(TriangleFragment f) {
    const uint leaf = voxelNumber(walk.grid, f.voxel);
    if (leaf != NO_VOXEL && isListed(f)) atomicAdd(counts.triangles[leaf], 1u);
}
