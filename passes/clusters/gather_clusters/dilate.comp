// Dilates the list of groups by their neighbors, which an iteration of the filter reads.
#include "passes/clusters/neighbors.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Groups { SurfaceGroup data[]; } groups;
readonly buffer FirstNeighbor { uint data[]; } firstNeighbor;
layout(scalar) readonly buffer NeighborsRef { LargeUints neighbors; };
buffer IsListed { uint data[]; } isListed;  // Per group.
buffer ListedGroups { uint data[]; } listedGroups;
buffer Count { uint value; } count;
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint first;  // Index in the list of the first group that the previous step added.
    uint groupCount;  // Number of groups that it added.
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.groupCount) return;
    const uint group = listedGroups.data[push.first + i];
    for (uint k = firstNeighbor.data[group]; k < firstNeighbor.data[group + 1u]; ++k) {
        const uint neighbor = neighborIndex(push.grid, groups.data[group], byteOf(neighbors.data[k / 4u], k));
        if (atomicExchange(isListed.data[neighbor], 1u) == 0u)
            listedGroups.data[atomicAdd(count.value, 1u)] = neighbor;
    }
}
