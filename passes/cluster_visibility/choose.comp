#version 460
#extension GL_GOOGLE_include_directive : require
// Which side a ray hit: that of the nearest surfel that nothing hides from the open space before the hit. Each round proposes one and
// the ray that asks whether something does; the next one takes it or looks for another. A thread takes a ray.
#include "passes/cluster_visibility/face_ray.glsl"
#include "shaders/scene/scene.glsl"
#include "shaders/surfels/surfel_bias.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

#define ROUNDS 4u
#define NO_SURFEL 0xffffffffu
const float FAR = 0.5;  // 0.7 voxels on one plane, or half a voxel and a plane 20 degrees off.

struct Proposal {
    uint surfel;
    uint hidden[ROUNDS];  // Sides that were proposed before.
};

layout(scalar) readonly buffer Rays { Ray data[]; } rays;
layout(scalar) readonly buffer Hits { Hit data[]; } hits;
layout(scalar) buffer Proposals { Proposal data[]; } proposals;
layout(scalar) writeonly buffer Between { Ray data[]; } between;  // From the hit to the proposal.
readonly buffer Occluded { uint data[]; } occluded;
readonly buffer FirstSide { uint data[]; } firstSide;
layout(scalar) writeonly buffer Targets { uint data[]; } targets;
buffer Missed { uint counts[2]; } missed;  // Rays that met nothing, and hits without a side.

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
uint targetAt(uint ray, PatchSurfel s) {
    const VoxelMaterial m = voxelMaterial(s.side);
    const vec3 area = mix(m.unoccludedPositive, m.unoccludedNegative, lessThan(s.normal, vec3(0.0)));
    const vec3 part = mix(vec3(0.0), s.normal * s.normal, greaterThan(area, vec3(0.0)));
    const float sum = part.x + part.y + part.z;
    if (sum == 0.0) return NO_TARGET;
    const float at = rayPick(ray) * sum;
    const uint axis = at < part.x ? 0u : at < part.x + part.y || part.z == 0.0 ? 1u : 2u;
    return targetOf(s.side, faceOf(s.normal, axis), hits.data[ray].t / push.grid.voxelSize);
}

void main() {
    const uint ray = linearIndex();
    if (ray >= push.rays) return;
    between.data[ray] = kNoRay;
    const Hit hit = hits.data[ray];
    Proposal proposal;
    if (push.round > 0u) {
        proposal = proposals.data[ray];
        if (proposal.surfel == NO_SURFEL) return;
        const PatchSurfel s = patchSurfels.data[proposal.surfel];
        if (occluded.data[ray] == 0u) {
            targets.data[ray] = targetAt(ray, s);
            proposals.data[ray].surfel = NO_SURFEL;
            return;
        }
        proposal.hidden[push.round - 1u] = s.side;
    }
    targets.data[ray] = NO_TARGET;
    proposals.data[ray].surfel = NO_SURFEL;
    if (hit.triangle == NO_HIT) {
        atomicAdd(missed.counts[0], 1u);
        return;
    }
    const vec3 direction = rays.data[ray].direction;
    const SurfacePoint p = surfacePoint(hit.triangle, vec2(hit.u, hit.v));
    const vec3 normal = dot(p.geometricNormal, direction) > 0.0 ? -p.geometricNormal : p.geometricNormal;
    proposal.surfel = push.round < ROUNDS ? nearestSurfel(p.position, normal, proposal) : NO_SURFEL;
    if (proposal.surfel == NO_SURFEL) {
        atomicAdd(missed.counts[1], 1u);
        return;
    }
    proposals.data[ray] = proposal;
    // The ray's own way to the hit is open.
    const PatchSurfel s = patchSurfels.data[proposal.surfel];
    const vec3 from = p.position - min(0.5 * hit.t, s.height) * direction;
    const vec3 way = raisedOver(s) - from;
    between.data[ray] = dot(way, way) > 0.0 ? Ray(from, 0.0, normalize(way), length(way)) : kNoRay;
}
