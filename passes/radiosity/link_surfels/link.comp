// Links each ray to the surfel that stands for the place where it hit.
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/scene.glsl"
#include "passes/surfels/sorted_surfels.glsl"
#include "passes/surfels/surfel_bias.glsl"
#include "shaders/trace/ray_types.h"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Rays { Ray data[]; } rays;
layout(scalar) readonly buffer Hits { Hit data[]; } hits;
readonly buffer Covered { uint data[]; } covered;  // Of the hit: 0 where open space lies before it, as far as a voxel.
layout(scalar) readonly buffer SortedAt { SortedSurfelWords sorted; };
readonly buffer Lists { uvec2 data[]; } lists;
layout(scalar) readonly buffer LinksAt { LargeUints links; };
buffer Unlinked { uint value; } unlinked;
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint firstNumber;  // Of the first ray's surfel.
    uint rayCount;
    uint raysPerSurfel;
    uint surfelCount;
} push;

const uint NONE = 0xffffffffu;
const float FAR = 0.5;  // 0.7 voxels on one plane, or half a voxel and a plane 20 degrees off.

// The surfel so far that is nearest, in voxels, squared, and of the same surface (surfel_bias.glsl).
struct Nearest {
    float distance_;
    uint number;
    uint id;
};

// Bias² of an open surfel for a covered place, and the other way round: that of two unrelated values.
const float OTHER_KIND = 2.0;

void visit(ivec3 voxel, vec3 position, vec3 normal, uint kind, inout Nearest nearest) {
    const uint number = voxelNumber(push.grid, voxel);
    if (number == NO_VOXEL) return;
    const uvec2 slots = lists.data[number];
    SortedSurfelWords words = sorted;  // The address is read once: no compiler takes it out of the loop.
    for (uint i = slots.x; i < slots.y; ++i) {
        const SortedSurfel s = sortedSurfel(words, i);
        if (dot(s.normal, normal) <= 0.0) continue;
        const vec3 away = s.position - position;
        const float d = dot(away, away) / (push.grid.voxelSize * push.grid.voxelSize) + surfelBias(position, normal, s.position, s.normal) +
                        ((s.id & VOXRAY_COVERED) == kind ? 0.0 : OTHER_KIND);
        if (d < nearest.distance_ || (d == nearest.distance_ && s.id < nearest.id)) nearest = Nearest(d, s.number, s.id);
    }
}

// The surfel of the voxel that the place lies in; of the voxels around it, too, where that one is as far as the voxel's own size
// allows or of another surface.
uint nearestSurfel(vec3 position, vec3 normal, uint kind) {
    const ivec3 voxel = voxelAt(push.grid, position);
    Nearest nearest = Nearest(1.0e30, NONE, NONE);
    visit(voxel, position, normal, kind, nearest);
    if (nearest.distance_ < FAR) return nearest.number;
    for (int i = 0; i < 27; ++i)
        if (i != 13) visit(voxel + ivec3(i % 3, (i / 3) % 3, i / 9) - 1, position, normal, kind, nearest);
    return nearest.number;
}

void main() {
    const uint i = linearIndex();
    if (i >= push.rayCount) return;
    uint number = NONE;
    if (hits.data[i].triangle != NO_HIT) {
        const uint kind = covered.data[i] != 0u ? VOXRAY_COVERED : 0u;
        const SurfacePoint p = surfacePoint(hits.data[i].triangle, vec2(hits.data[i].u, hits.data[i].v));
        const vec3 n = dot(p.geometricNormal, rays.data[i].direction) <= 0.0 ? p.geometricNormal : -p.geometricNormal;
        number = nearestSurfel(p.position, n, kind);
        if (number == NONE) atomicAdd(unlinked.value, 1u);
    }
    links.data[(i % push.raysPerSurfel) * push.surfelCount + push.firstNumber + i / push.raysPerSurfel] = number;
}
