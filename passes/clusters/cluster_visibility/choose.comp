// Which side a ray hit: that of the nearest surfel that nothing hides from the open space before the hit. Each round proposes one and
// the ray that asks whether something does; the next one takes it or looks for another. A thread takes a listed ray.
#include "passes/clusters/cluster_visibility/face_ray.glsl"
#include "shaders/scene/scene.glsl"
#include "passes/surfels/surfel_bias.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

#define ROUNDS 4u
#define NO_SURFEL 0xffffffffu
const float FAR = 0.5;  // 0.7 voxels on one plane, or half a voxel and a plane 20 degrees off.

struct Proposal {
    uint surfel;
    uint hidden[ROUNDS];  // Sides that were proposed before.
};

readonly buffer List { uint data[]; } list;
layout(scalar) readonly buffer Rays { Ray data[]; } rays;
layout(scalar) readonly buffer Hits { Hit data[]; } hits;
layout(scalar) buffer Proposals { Proposal data[]; } proposals;
layout(scalar) writeonly buffer Between { Ray data[]; } between;  // From the hit to the proposal.
readonly buffer Occluded { uint data[]; } occluded;
readonly buffer FirstSide { uint data[]; } firstSide;
writeonly buffer Met { uint data[]; } met;

struct Nearest {
    float distance_;  // Voxels, squared, and of the same surface (surfel_bias.glsl).
    uint surfel;
    uint id;
};

bool wasHidden(Proposal p, uint side) {
    for (uint i = 0u; i < push.round; ++i)
        if (p.hidden[i] == side) return true;
    return false;
}

void visit(ivec3 voxel, vec3 position, vec3 normal, Proposal before, inout Nearest nearest) {
    const uint number = voxelNumber(push.grid, voxel);
    if (number == NO_VOXEL) return;
    for (uint side = firstSide.data[number]; side < firstSide.data[number + 1u]; ++side) {
        if (wasHidden(before, side)) continue;
        const uint first = sides.data[side].firstSurfel;
        for (uint i = first; i < first + sides.data[side].surfels; ++i) {
            const PatchSurfel s = patchSurfels.data[i];
            if (dot(s.normal, normal) <= 0.0) continue;
            const vec3 away = s.position - position;
            const float d = dot(away, away) / (push.grid.voxelSize * push.grid.voxelSize) + surfelBias(position, normal, s.position, s.normal);
            if (d < nearest.distance_ || (d == nearest.distance_ && s.id < nearest.id)) nearest = Nearest(d, i, s.id);
        }
    }
}

// The surfel of the voxel that the hit lies in; of the voxels around it, too, where that one is as far as the voxel's own size allows
// or of another surface.
uint nearestSurfel(vec3 position, vec3 normal, Proposal before) {
    const ivec3 voxel = voxelAt(push.grid, position);
    Nearest nearest = Nearest(1.0e30, NO_SURFEL, NO_SURFEL);
    visit(voxel, position, normal, before, nearest);
    if (nearest.distance_ < FAR) return nearest.surfel;
    for (int i = 0; i < 27; ++i)
        if (i != 13) visit(voxel + ivec3(i % 3, (i / 3) % 3, i / 9) - 1, position, normal, before, nearest);
    return nearest.surfel;
}

// One of the faces that have area of a surfel.
uint metAt(uint ray, PatchSurfel s, float away) {
    const VoxelMaterial m = voxelMaterial(s.side);
    const vec3 area = mix(m.unoccludedPositive, m.unoccludedNegative, lessThan(s.normal, vec3(0.0)));
    const vec3 part = mix(vec3(0.0), s.normal * s.normal, greaterThan(area, vec3(0.0)));
    const float sum = part.x + part.y + part.z;
    if (sum == 0.0) return metAway(s.side, NO_FACE, away);
    const float at = rayPick(ray) * sum;
    const uint axis = at < part.x ? 0u : at < part.x + part.y || part.z == 0.0 ? 1u : 2u;
    return metAway(s.side, faceOf(s.normal, axis), away);
}

void main() {
    const uint i = linearIndex();
    if (i >= push.rayCount) return;
    const uint ray = list.data[i];
    between.data[i] = kNoRay;
    const Hit hit = hits.data[i];
    Proposal proposal;
    if (push.round > 0u) {
        proposal = proposals.data[i];
        if (proposal.surfel == NO_SURFEL) return;
        const PatchSurfel s = patchSurfels.data[proposal.surfel];
        if (occluded.data[i] == 0u) {
            met.data[ray] = metAt(ray, s, hit.t / push.grid.voxelSize);
            proposals.data[i].surfel = NO_SURFEL;
            return;
        }
        proposal.hidden[push.round - 1u] = s.side;
    }
    proposals.data[i].surfel = NO_SURFEL;
    if (hit.triangle == NO_HIT) {
        met.data[ray] = MET_NOTHING;
        return;
    }
    const vec3 direction = rays.data[i].direction;
    const SurfacePoint p = surfacePoint(hit.triangle, vec2(hit.u, hit.v));
    const vec3 normal = dot(p.geometricNormal, direction) > 0.0 ? -p.geometricNormal : p.geometricNormal;
    proposal.surfel = push.round < ROUNDS ? nearestSurfel(p.position, normal, proposal) : NO_SURFEL;
    if (proposal.surfel == NO_SURFEL) {
        met.data[ray] = MET_NO_SIDE;
        return;
    }
    proposals.data[i] = proposal;
    // The ray's own way to the hit is open.
    const PatchSurfel s = patchSurfels.data[proposal.surfel];
    const vec3 from = p.position - min(0.5 * hit.t, s.height) * direction;
    const vec3 way = raisedOver(s) - from;
    between.data[i] = dot(way, way) > 0.0 ? Ray(from, 0.0, normalize(way), length(way)) : kNoRay;
}
