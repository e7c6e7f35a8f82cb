// Origins and directions of rays from patches. Each patch of a chunk has raysPerPatch consecutive rays.
#include "passes/clusters/cluster_visibility/packed_hit.glsl"
#include "passes/clusters/cluster_visibility/patch_surfel.h"
#include "passes/clusters/surface_group_types.h"
#include "passes/clusters/visibility_list_types.h"
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/sampling.glsl"
#include "shaders/voxels/face.glsl"
#include "shaders/voxels/voxels.glsl"

layout(scalar) readonly buffer PatchFaces { uint data[]; } patchFaces;  // 6 * group + face of each patch.
layout(scalar) readonly buffer Groups { SurfaceGroup data[]; } groups;
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    VisibilityListLayout listLayout;
    uint firstPatch;     // First patch of the chunk.
    uint rayCount;       // Number of rays in the chunk or in the list.
    uint seed;
    float nearDistance;  // Voxels. Targets closer than that are patches, others are component faces.
    uint aboutFaceAxis;  // 1: hemispheres about the face's axis. 0: about the surfel's normal.
    uint round;          // Used by find_hit_groups.comp.
} push;

uint rayGroup(uint ray) { return patchFaces.data[push.firstPatch + ray / push.listLayout.raysPerPatch] / 6u; }
uint rayFace(uint ray) { return patchFaces.data[push.firstPatch + ray / push.listLayout.raysPerPatch] % 6u; }

// Seed of a patch's sequence 0 (direction), 1 (origin) or 2 (face of the hit). It depends on a surfel's id instead of
// the group's index, which changes in updates.
uint raySeed(uint ray, uint sequence) {
    const uint surfelId = patchSurfels.data[groups.data[rayGroup(ray)].firstSurfel].id;
    return hashCombine(hashCombine(hashCombine(push.seed, sequence), surfelId), rayFace(ray));
}

// Area of a surfel at a face, as a fraction of its area: squared cosine, 0 for faces behind it.
float areaAtFace(PatchSurfel s, uint face) {
    const float cosine = s.normal[face >> 1];
    return (face & 1u) == (cosine < 0.0 ? 1u : 0u) ? cosine * cosine : 0.0;
}

// The surfel at the origin of a ray: one of the group's, with probability proportional to areaAtFace().
PatchSurfel sampleSurfel(uint ray) {
    const uint face = rayFace(ray);
    const uint first = groups.data[rayGroup(ray)].firstSurfel, end = groups.data[rayGroup(ray) + 1u].firstSurfel;
    float totalArea = 0.0;
    for (uint i = first; i < end; ++i) totalArea += areaAtFace(patchSurfels.data[i], face);
    float remaining = totalArea * sobol2(ray % push.listLayout.raysPerPatch, raySeed(ray, 1u)).x;
    uint sampled = first;
    for (uint i = first; i < end; ++i) {
        const float area = areaAtFace(patchSurfels.data[i], face);
        if (area == 0.0) continue;
        sampled = i;
        remaining -= area;
        if (remaining < 0.0) break;
    }
    return patchSurfels.data[sampled];
}

// Cosine-distributed about the surfel's normal or the face's axis.
vec3 sampleDirection(uint ray, PatchSurfel s) {
    const vec3 axis = push.aboutFaceAxis == 1u ? faceNormal(rayFace(ray)) : s.normal;
    return cosineDirection(sobol2(ray % push.listLayout.raysPerPatch, raySeed(ray, 0u)), axis);
}

// Random number in [0, 1) that selects one of the faces at the ray's hit.
float sampleHitFace(uint ray) { return toUnit(hashCombine(raySeed(ray, 2u), ray % push.listLayout.raysPerPatch)); }

// @param distance_ in voxels.
uint packHitAtDistance(uint group, uint face, float distance_) {
    return packHit(group, face, distance_ < push.nearDistance);
}
