// Which octants of its leaf a triangle overlaps: a bit each, by octantOf(). Octants are larger by OCTANT_MARGIN on each side.
#ifndef VOXRAY_LEAF_OCTANTS_GLSL
#define VOXRAY_LEAF_OCTANTS_GLSL

#include "shaders/hybrid_leaves/hybrid_types.h"
#include "shaders/octree/octree_cells.glsl"

uint octantsOf(TriangleFragment f) {
    // Octants are the voxels of a grid that is twice as fine
    GridTriangle t = f.permutedTriangle;
    t.p0 *= 2.0;
    t.p1 *= 2.0;
    t.p2 *= 2.0;
    t.lower *= 2.0;
    t.upper *= 2.0;
    t.planeError *= 2.0;
    uint octants = 0u;
    for (uint octant = 0u; octant < 8u; ++octant) {
        const ivec3 offset = ivec3(permutedVoxels(uvec3(octantOffset(octant)), t.axis));
        if (meetsVoxel(t, 2 * f.permutedVoxel + offset, 2.0 * OCTANT_MARGIN)) octants |= 1u << octant;
    }
    return octants;
}

#endif
