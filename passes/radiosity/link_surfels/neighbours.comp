// Lists the surfels around each surfel: those of the 27 voxels about it that lie within a radius and look to the same side.
// COUNT tells how many there are; then, with the sums of these, they are written.
#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/neighbours.glsl"
#include "passes/surfels/packed_surfel.glsl"
#include "passes/surfels/sorted_surfels.glsl"
#include "passes/surfels/surfel_bias.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer SortedAt { SortedSurfelWords sorted; };
readonly buffer Lists { uvec2 data[]; } lists;
#ifdef COUNT
buffer Counts { uint data[]; } counts;
buffer Largest { uint value; } largest;
#else
readonly buffer Begins { uint data[]; } begins;
layout(scalar) readonly buffer PackedAt { PackedSurfels packed_; };
layout(scalar) readonly buffer PairsAt { NeighbourPairs pairs; };
#endif
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint slots;
    float radius;  // m, at most a voxel's size.
} push;

void main() {
    const uint slot = linearIndex();
    if (slot >= push.slots) return;
    SortedSurfelWords words = sorted;  // The address is read once: no compiler takes it out of the loops.
    const SortedSurfel own = sortedSurfel(words, slot);
    const ivec3 voxel = voxelAt(push.grid, own.position);
    const float squaredRadius = push.radius * push.radius;
#ifdef COUNT
    uint count = 0u;
#else
    uint next = begins.data[slot];
    const float ownInverse = inverseDistanceOf(packed_.data[slot].y);
#endif
    for (int i = 0; i < 27; ++i) {
        const uint number = voxelNumber(push.grid, voxel + ivec3(i % 3, (i / 3) % 3, i / 9) - 1);
        if (number == NO_VOXEL) continue;
        const uvec2 slots = lists.data[number];
        for (uint j = slots.x; j < slots.y; ++j) {
            const SortedSurfel s = sortedSurfel(words, j);
            const vec3 away = s.position - own.position;
            const float squared = dot(away, away);
            if (j == slot || squared >= squaredRadius || dot(s.normal, own.normal) <= 0.0) continue;
            if (((s.id ^ own.id) & VOXRAY_COVERED) != 0u) continue;  // Light in a gap says nothing of light before it.
#ifdef COUNT
            ++count;
#else
            const float inverse = 0.5 * (ownInverse + inverseDistanceOf(packed_.data[j].y)) / push.grid.voxelSize;
            const float bias = surfelBias(own.position, own.normal, s.position, s.normal) + distanceBias(squared, inverse);
            pairs.data[next++] = packNeighbour(j, bias, 1.0 - squared / squaredRadius);
#endif
        }
    }
#ifdef COUNT
    counts.data[slot] = count;
    atomicMax(largest.value, count);
#endif
}
