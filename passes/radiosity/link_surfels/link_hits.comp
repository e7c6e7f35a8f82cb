// Links each ray to the surfel that best stands for its hit: one in the hit's voxel, or, where none there is close enough,
// one in the 26 voxels around it, too. The latter are listed, and linked by a second dispatch, with ADJACENT: few in each
// group of rays would keep all others waiting. KEEPS_HITS: stores hits, for updates, which trace listed rays alone.
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/scene.glsl"
#ifdef KEEPS_HITS
#include "passes/radiosity/link_surfels/link_hit.glsl"
#endif
#include "passes/surfels/sorted_surfels.glsl"
#include "passes/surfels/surfel_bias.glsl"
#include "shaders/trace/ray_types.h"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Rays { Ray data[]; } rays;
layout(scalar) readonly buffer Hits { Hit data[]; } hits;
readonly buffer Occluded { uint data[]; } occluded;  // Of the hit: 0 where no surface lies within a voxel before it.
layout(scalar) readonly buffer SortedRef { SortedSurfelWords sorted; };
readonly buffer SurfelRanges { uvec2 data[]; } surfelRanges;
layout(scalar) readonly buffer LinksRef { LargeUints links; };
buffer FarRays { uint data[]; } farRays;  // Whose hits are left to the second dispatch.
buffer FarCount { uint value; } farCount;
#ifdef ADJACENT
buffer UnlinkedHits { uint value; } unlinkedHits;
#endif
#ifdef KEEPS_HITS
#ifndef ADJACENT
layout(scalar) readonly buffer LinkHitsRef { LargeUints linkHits; };        // link_hit.glsl
layout(scalar) readonly buffer InverseSumsRef { LargeUints inverseSums; };  // By surfel (mean_inverse_distance.comp).
#endif
readonly buffer ListedRays { uint data[]; } listedRays;
#endif
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint firstSurfel;  // Of the batch.
    uint rayCount;
    uint raysPerSurfel;
    uint surfelCount;
#ifdef KEEPS_HITS
    uint isListed;  // 0 or 1.
#endif
} push;

const uint NO_SURFEL = 0xffffffffu;
const float MAX_ERROR = 0.5;  // 0.7 voxels on one plane, or half a voxel and a plane 20 degrees off.

// The best surfel so far, by squared distance in voxels plus squared bias (surfel_bias.glsl).
struct NearestSurfel {
    float error;
    uint surfel;
    uint id;
};

// Squared bias between an unoccluded and an occluded surface point: that of two unrelated values.
const float OCCLUSION_MISMATCH = 2.0;

void searchVoxel(ivec3 voxel, vec3 position, vec3 normal, uint occlusion, inout NearestSurfel nearest) {
    const uint list = voxelNumber(push.grid, voxel);
    if (list == NO_VOXEL) return;
    const uvec2 range = surfelRanges.data[list];
    SortedSurfelWords words = sorted;  // Loop-invariant load, which compilers do not hoist.
    for (uint i = range.x; i < range.y; ++i) {
        const SortedSurfel s = sortedSurfel(words, i);
        if (dot(s.normal, normal) <= 0.0) continue;
        const vec3 offset = s.position - position;
        const float error = dot(offset, offset) / (push.grid.voxelSize * push.grid.voxelSize) +
                            surfelBias(position, normal, s.position, s.normal) +
                            ((s.id & VOXRAY_OCCLUDED) == occlusion ? 0.0 : OCCLUSION_MISMATCH);
        if (error < nearest.error || (error == nearest.error && s.id < nearest.id))
            nearest = NearestSurfel(error, s.index, s.id);
    }
}

NearestSurfel nearestSurfel(vec3 position, vec3 normal, uint occlusion) {
    const ivec3 voxel = voxelAt(push.grid, position);
    NearestSurfel nearest = NearestSurfel(1.0e30, NO_SURFEL, NO_SURFEL);
    searchVoxel(voxel, position, normal, occlusion, nearest);
#ifdef ADJACENT
    for (int i = 0; i < 27; ++i)
        if (i != 13) searchVoxel(voxel + ivec3(i % 3, (i / 3) % 3, i / 9) - 1, position, normal, occlusion, nearest);
#endif
    return nearest;
}

NearestSurfel nearestToHit(uint i) {
    const uint occlusion = occluded.data[i] != 0u ? VOXRAY_OCCLUDED : 0u;
    const SurfacePoint p = surfacePoint(hits.data[i].triangle, vec2(hits.data[i].u, hits.data[i].v));
    const vec3 n = dot(p.geometricNormal, rays.data[i].direction) <= 0.0 ? p.geometricNormal : -p.geometricNormal;
    return nearestSurfel(p.position, n, occlusion);
}

// Surfel and number of a ray, as the batch counts its rays.
uvec2 surfelAndRay(uint i) {
#ifdef KEEPS_HITS
    const uint ray = push.isListed != 0u ? listedRays.data[i] : i;
#else
    const uint ray = i;
#endif
    return uvec2(push.firstSurfel + ray / push.raysPerSurfel, ray % push.raysPerSurfel);
}

void setLink(uint i, uint linked) {
    const uvec2 ray = surfelAndRay(i);
    links.data[ray.y * push.surfelCount + ray.x] = linked;
}

#if defined(KEEPS_HITS) && !defined(ADJACENT)
void keepHit(uint i) {
    const float distance_ = hits.data[i].triangle != NO_HIT ? hits.data[i].t / push.grid.voxelSize : NO_LINK_HIT;
    const uint hit = packLinkHit(rays.data[i].direction, distance_);
    const uvec2 ray = surfelAndRay(i);
    const uint index = linkHitIndex(ray.x, ray.y, push.raysPerSurfel);
    if (push.isListed != 0u) {
        const float units = inverseDistanceUnits(push.raysPerSurfel);
        const uint change = linkInverseDistance(hit, units) - linkInverseDistance(linkHits.data[index], units);
        if (change != 0u) atomicAdd(inverseSums.data[ray.x], change);
    }
    linkHits.data[index] = hit;
}
#endif

#ifdef ADJACENT
void main() {
    const uint listed = linearIndex();
    if (listed >= farCount.value) return;
    const uint i = farRays.data[listed], surfel = nearestToHit(i).surfel;
    if (surfel == NO_SURFEL) atomicAdd(unlinkedHits.value, 1u);
    setLink(i, surfel);
}
#else
void main() {
    const uint i = linearIndex();
    if (i >= push.rayCount) return;
    NearestSurfel nearest = NearestSurfel(0.0, NO_SURFEL, NO_SURFEL);
    if (hits.data[i].triangle != NO_HIT) nearest = nearestToHit(i);
#ifdef KEEPS_HITS
    if (rays.data[i].tMax < 0.0) nearest.surfel = LINK_NOT_TRACED;
#endif
    if (nearest.error < MAX_ERROR)
        setLink(i, nearest.surfel);
    else
        farRays.data[atomicAdd(farCount.value, 1u)] = i;
#ifdef KEEPS_HITS
    keepHit(i);
#endif
}
#endif
