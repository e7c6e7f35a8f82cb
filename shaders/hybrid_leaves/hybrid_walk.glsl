// Rays through the leaves of a hybrid octree (Seok 2021, chapter 4; docs/hybrid-leaves.md): the closest triangle of a list, or cell of a
// grid. The including shader is compiled with VoxelMarch::defines(), which tell the walk from leaf to leaf, and given its bindings,
// those of HybridLeaves and those of the scene. Triangles that leaves hold are the second exception to the rule that passes trace
// streams alone (docs/writing-a-pass.md).
#ifndef VOXRAY_HYBRID_WALK_GLSL
#define VOXRAY_HYBRID_WALK_GLSL

#include "shaders/hybrid_leaves/hybrid_leaves.glsl"
#include "shaders/hybrid_leaves/ray_triangle.glsl"
#include "shaders/voxel_march/voxel_march.glsl"

// Rays and triangles of lists that this thread has tested.
uint hybridTests = 0u;

// Tests all triangles of a list, also where they reach out of their leaf: the closest of all counts.
void meetList(vec3 origin, vec3 direction, float tMin, uint first, inout Hit best) {
    for (uint i = 0u; i < hybridLeaves.shape.capacity; ++i) {
        const uint word = hybridLeaves.primitives.data[first + i], triangle = word & ~LIST_ENDS;
        if (triangle != best.triangle) {
            ++hybridTests;
            meetTriangle(origin, direction, tMin, triangle, best);
        }
        if ((word & LIST_ENDS) != 0u) break;
    }
}

// The closest surface on a ray from `origin` (m) between tMin and tMax, which may be infinite; t counts in multiples of `direction`.
// Hit::triangle tells what it is (shaders/hybrid_leaves/hybrid_types.h), Hit::t is tMax where it is NO_HIT. `start`: what the ray
// leaves behind, RayStart(vec3(0.0), 0.0, 0.0) for a bare ray.
Hit hybridClosest(VoxelGrid g, vec3 origin, vec3 direction, float tMin, float tMax, RayStart start) {
    Hit best = Hit(tMax, NO_HIT, 0.0, 0.0);
    float from = tMin, to = tMax;
    VoxelSegment s;
    if (!segmentOfRay(g, origin, direction, from, to, s)) return best;
    const float rounding = MARCH_TIE * (to - from);
    beginWalk(g, s);
    ivec3 at = firstVoxel(s);
    const uint bound = voxelsBetween(s);
    for (uint i = 0u; i <= bound; ++i) {
        if (!walkOn(g, s, at)) break;
        const uint leaf = hybridLeaves.words.data[voxelNumber(g, at ^ s.flip)];
        if (!isEmptyLeaf(leaf)) meetList(origin, direction, tMin, leaf, best);

        // A hit within the leaf is the closest: whatever is closer has a part in this leaf or in those before. One behind it may be
        // hidden yet.
        const vec3 parts = partsTo(s, unitsTo(s, at + 1));
        const float leaves = from + min(parts.x, min(parts.y, parts.z)) * (to - from);
        if (best.triangle != NO_HIT && best.t <= leaves - rounding) break;
        if (!leaveVoxel(s, at)) break;
    }
    return best;
}

#endif
