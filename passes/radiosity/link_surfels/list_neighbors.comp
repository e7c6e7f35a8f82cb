// Lists the neighbors of each surfel: surfels in the 27 voxels around it within a radius, of similar normals and equal
// occlusion. COUNT counts them; then they are written by the counts' prefix sums.
#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/neighbors.glsl"
#include "passes/surfels/packed_surfel.glsl"
#include "passes/surfels/sorted_surfels.glsl"
#include "passes/surfels/surfel_bias.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer SortedRef { SortedSurfelWords sorted; };
readonly buffer SurfelRanges { uvec2 data[]; } surfelRanges;
#ifdef COUNT
buffer Counts { uint data[]; } counts;
buffer Largest { uint value; } largest;
#else
readonly buffer Begins { uint data[]; } begins;
layout(scalar) readonly buffer PackedRef { PackedSurfels packed_; };
layout(scalar) readonly buffer PairsRef { NeighborPairs pairs; };
#endif
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint count;
    float radius;  // m, at most a voxel.
} push;

void main() {
    const uint surfel = linearIndex();
    if (surfel >= push.count) return;
    SortedSurfelWords words = sorted;  // Loop-invariant load, which compilers do not hoist.
    const SortedSurfel center = sortedSurfel(words, surfel);
    const ivec3 voxel = voxelAt(push.grid, center.position);
    const float squaredRadius = push.radius * push.radius;
#ifdef COUNT
    uint count = 0u;
#else
    uint next = begins.data[surfel];
    const float centerInverse = unpackInverseDistance(packed_.data[surfel].y);
#endif
    for (int i = 0; i < 27; ++i) {
        const uint list = voxelNumber(push.grid, voxel + ivec3(i % 3, (i / 3) % 3, i / 9) - 1);
        if (list == NO_VOXEL) continue;
        const uvec2 range = surfelRanges.data[list];
        for (uint j = range.x; j < range.y; ++j) {
            const SortedSurfel neighbor = sortedSurfel(words, j);
            const vec3 offset = neighbor.position - center.position;
            const float distanceSquared = dot(offset, offset);
            if (j == surfel || distanceSquared >= squaredRadius) continue;
            if (dot(neighbor.normal, center.normal) <= 0.0) continue;
            if (((neighbor.id ^ center.id) & VOXRAY_OCCLUDED) != 0u) continue;  // Light in a gap is independent.
#ifdef COUNT
            ++count;
#else
            const float inverse = unpackInverseDistance(packed_.data[j].y);
            const float meanInverse = 0.5 * (centerInverse + inverse) / push.grid.voxelSize;
            const float bias = surfelBias(center.position, center.normal, neighbor.position, neighbor.normal) +
                               distanceBias(distanceSquared, meanInverse);
            pairs.data[next++] = packNeighbor(j, bias, 1.0 - distanceSquared / squaredRadius);
#endif
        }
    }
#ifdef COUNT
    counts.data[surfel] = count;
    atomicMax(largest.value, count);
#endif
}
