// Finds the surface group that a ray hit: that of the nearest surfel that is visible from a point in front of the hit.
// Each round selects the nearest surfel among groups not yet rejected and generates an occlusion ray to it. The next
// round accepts the surfel's group if that ray is unoccluded and else rejects it.
#include "passes/clusters/cluster_visibility/patch_samples.glsl"
#include "passes/clusters/group_materials.glsl"
#include "shaders/scene/scene.glsl"
#include "passes/surfels/surfel_bias.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

#define MAX_CANDIDATES 4u
#define NO_SURFEL 0xffffffffu
// Limit of NearestSurfel::cost: reached at sqrt(0.5) = 0.7 voxels by surfels in one plane, at about half a voxel where
// normals differ by 20 degrees.
const float FAR = 0.5;

struct Candidate {
    uint surfel;
    uint group;
    uint rejectedGroups[MAX_CANDIDATES];  // Per round.
};

readonly buffer ListedRays { uint data[]; } listedRays;
layout(scalar) readonly buffer Rays { Ray data[]; } rays;
layout(scalar) readonly buffer Hits { Hit data[]; } hits;
layout(scalar) buffer Candidates { Candidate data[]; } candidates;
layout(scalar) writeonly buffer OcclusionRays { Ray data[]; } occlusionRays;  // From the hit to the candidate.
readonly buffer Occluded { uint data[]; } occluded;                            // Results of the previous round's rays.
readonly buffer FirstGroup { uint data[]; } firstGroup;
writeonly buffer PackedHits { uint data[]; } packedHits;

struct NearestSurfel {
    float cost;  // Squared distance in voxels, plus surfelBias().
    uint surfel;
    uint group;
    uint id;
};

bool isRejected(Candidate candidate, uint group) {
    for (uint i = 0u; i < push.round; ++i)
        if (candidate.rejectedGroups[i] == group) return true;
    return false;
}

void searchVoxel(ivec3 voxel, vec3 position, vec3 normal, Candidate candidate, inout NearestSurfel nearest) {
    const uint number = voxelNumber(push.grid, voxel);
    if (number == NO_VOXEL) return;
    for (uint group = firstGroup.data[number]; group < firstGroup.data[number + 1u]; ++group) {
        if (isRejected(candidate, group)) continue;
        const uint end = groups.data[group + 1u].firstSurfel;
        for (uint i = groups.data[group].firstSurfel; i < end; ++i) {
            const PatchSurfel s = patchSurfels.data[i];
            if (dot(s.normal, normal) <= 0.0) continue;
            const vec3 offset = s.position - position;
            const float d = dot(offset, offset) / (push.grid.voxelSize * push.grid.voxelSize) +
                            surfelBias(position, normal, s.position, s.normal);
            if (d < nearest.cost || (d == nearest.cost && s.id < nearest.id))
                nearest = NearestSurfel(d, i, group, s.id);
        }
    }
}

// Searches the hit's voxel and, if the nearest surfel there is FAR, the 26 adjacent ones.
NearestSurfel nearestSurfel(vec3 position, vec3 normal, Candidate candidate) {
    const ivec3 voxel = voxelAt(push.grid, position);
    NearestSurfel nearest = NearestSurfel(1.0e30, NO_SURFEL, NO_GROUP, NO_SURFEL);
    searchVoxel(voxel, position, normal, candidate, nearest);
    if (nearest.cost < FAR) return nearest;
    for (int i = 0; i < 27; ++i)
        if (i != 13) searchVoxel(voxel + ivec3(i % 3, (i / 3) % 3, i / 9) - 1, position, normal, candidate, nearest);
    return nearest;
}

// Packs the group and one of the faces at which the group and the surfel both have area, sampled with probability
// proportional to the surfel's area there.
uint packSurfelHit(uint ray, PatchSurfel s, uint group, float distance_) {
    const VoxelMaterial m = groupMaterial(group);
    const vec3 groupArea = mix(m.unoccludedPositive, m.unoccludedNegative, lessThan(s.normal, vec3(0.0)));
    const vec3 area = mix(vec3(0.0), s.normal * s.normal, greaterThan(groupArea, vec3(0.0)));
    const float sum = area.x + area.y + area.z;
    if (sum == 0.0) return packHitAtDistance(group, NO_FACE, distance_);
    const float threshold = sampleHitFace(ray) * sum;
    const uint axis = threshold < area.x ? 0u : threshold < area.x + area.y || area.z == 0.0 ? 1u : 2u;
    return packHitAtDistance(group, faceOf(s.normal, axis), distance_);
}

void main() {
    const uint i = linearIndex();
    if (i >= push.rayCount) return;
    const uint ray = listedRays.data[i];
    occlusionRays.data[i] = kNoRay;
    const Hit hit = hits.data[i];
    Candidate candidate;
    if (push.round > 0u) {
        candidate = candidates.data[i];
        if (candidate.surfel == NO_SURFEL) return;
        if (occluded.data[i] == 0u) {
            packedHits.data[ray] = packSurfelHit(ray, patchSurfels.data[candidate.surfel], candidate.group,
                                                 hit.t / push.grid.voxelSize);
            candidates.data[i].surfel = NO_SURFEL;
            return;
        }
        candidate.rejectedGroups[push.round - 1u] = candidate.group;
    }
    candidates.data[i].surfel = NO_SURFEL;
    if (hit.triangle == NO_HIT) {
        packedHits.data[ray] = HIT_NOTHING;
        return;
    }
    const vec3 direction = rays.data[i].direction;
    const SurfacePoint p = surfacePoint(hit.triangle, vec2(hit.u, hit.v));
    const vec3 normal = dot(p.geometricNormal, direction) > 0.0 ? -p.geometricNormal : p.geometricNormal;
    candidate.surfel = NO_SURFEL;
    if (push.round < MAX_CANDIDATES) {
        const NearestSurfel nearest = nearestSurfel(p.position, normal, candidate);
        candidate.surfel = nearest.surfel;
        candidate.group = nearest.group;
    }
    if (candidate.surfel == NO_SURFEL) {
        packedHits.data[ray] = HIT_NO_GROUP;
        return;
    }
    candidates.data[i] = candidate;
    // The origin lies on the ray, which is unoccluded up to its hit
    const PatchSurfel s = patchSurfels.data[candidate.surfel];
    const vec3 origin = p.position - min(0.5 * hit.t, s.height) * direction;
    const vec3 toSurfel = pointAbove(s) - origin;
    if (dot(toSurfel, toSurfel) > 0.0)
        occlusionRays.data[i] = Ray(origin, 0.0, normalize(toSurfel), length(toSurfel));
}
