// Rays from the patches of voxels' sides, numbered from the first patch in hand on: those of a patch come one after another. Materials
// of shaders/voxels/voxels.glsl are those of sides.
#include "passes/clusters/cluster_visibility/met.glsl"
#include "passes/clusters/patches.glsl"
#include "passes/clusters/seen_types.h"
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/sampling.glsl"
#include "shaders/voxel_march/surface_segment.glsl"
#include "shaders/voxels/face.glsl"
#include "shaders/voxels/voxels.glsl"

layout(scalar) readonly buffer Faces { uint data[]; } faces;  // By patch: 6 * side + face.
layout(scalar) readonly buffer Sides { SurfaceSide data[]; } sides;
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    SeenLayout lists;
    uint firstPatch;  // In hand.
    uint rayCount;    // Of all patches in hand, or listed ones.
    uint seed;
    float nearDistance;  // Voxels: what is nearer is seen by patches, not by parts of clusters.
    uint alongAxis;      // 1: the hemisphere stands on the face. 0: on the surface.
    uint round;          // Of the search for what was hit.
} push;

uint rayFace(uint ray) { return faces.data[push.firstPatch + ray / push.lists.raysPerPatch]; }

// Numbers of a patch's sequences: direction, place, pick. By a surfel's id, which stays when sides are numbered otherwise.
uint raySeed(uint ray, uint sequence) {
    const uint surfel = patchSurfels.data[sides.data[rayFace(ray) / 6u].firstSurfel].id;
    return hashCombine(hashCombine(hashCombine(push.seed, sequence), surfel), rayFace(ray) % 6u);
}

// The area of a surfel that a face has.
float areaAt(PatchSurfel s, uint face) {
    const float along = s.normal[face >> 1];
    return (face & 1u) == (along < 0.0 ? 1u : 0u) ? along * along : 0.0;
}

// The surfel that a ray rises from: one of its side's, by the area that its face has of them.
PatchSurfel raySurfel(uint ray) {
    const uint face = rayFace(ray) % 6u;
    const SurfaceSide side = sides.data[rayFace(ray) / 6u];
    float area = 0.0;
    for (uint i = 0u; i < side.surfels; ++i) area += areaAt(patchSurfels.data[side.firstSurfel + i], face);
    float at = area * sobol2(ray % push.lists.raysPerPatch, raySeed(ray, 1u)).x;
    uint last = side.firstSurfel;
    for (uint i = 0u; i < side.surfels; ++i) {
        const float own = areaAt(patchSurfels.data[side.firstSurfel + i], face);
        if (own == 0.0) continue;
        last = side.firstSurfel + i;
        at -= own;
        if (at < 0.0) break;
    }
    return patchSurfels.data[last];
}

// By the cosine about the surfel's normal, or the face's axis.
vec3 rayDirection(uint ray, PatchSurfel s) {
    const vec3 about = push.alongAxis == 1u ? faceNormal(rayFace(ray) % 6u) : s.normal;
    return cosineDirection(sobol2(ray % push.lists.raysPerPatch, raySeed(ray, 0u)), about);
}

float rayPick(uint ray) { return toUnit(hashCombine(raySeed(ray, 2u), ray % push.lists.raysPerPatch)); }

// What a ray met at a side, so many voxels away.
uint metAway(uint side, uint face, float away) { return metSide(side, face, away < push.nearDistance); }
