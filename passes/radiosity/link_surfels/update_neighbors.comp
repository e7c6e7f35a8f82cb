// Lists the neighbors of surfels near a change again: in place, or behind all lists where they have become too many.
#define WRITES
#define BY_SURFEL
#include "passes/radiosity/link_surfels/neighborhood.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer ListedSurfels { uint data[]; } listedSurfels;
layout(scalar) readonly buffer SortedIndicesRef { LargeUints sortedIndices; };
buffer Ranges { uvec2 data[]; } ranges;
buffer Places { uint data[]; } places;
buffer Used { uint pairs, places; } used;  // Of all lists. Places may exceed those that there are.
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint count;
    float radius;  // m, at most a voxel.
    uint allPlaces;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const uint surfel = listedSurfels.data[i], sortedIndex = sortedIndices.data[surfel];
    const bool exists = sortedIndex != 0xffffffffu;
    const uint count = exists ? listNeighbors(push.grid, push.radius, sortedIndex, false, 0u) : 0u;
    const uvec2 before = ranges.data[surfel];
    atomicAdd(used.pairs, count - (before.y - before.x));
    uint begin = before.x;
    if (count > places.data[surfel]) {
        const uint wanted = count + count / 2u;  // So that a list seldom moves again.
        begin = atomicAdd(used.places, wanted);
        if (begin + wanted > push.allPlaces) return;
        places.data[surfel] = wanted;
    }
    ranges.data[surfel] = uvec2(begin, begin + count);
    if (exists) listNeighbors(push.grid, push.radius, sortedIndex, true, begin);
}
