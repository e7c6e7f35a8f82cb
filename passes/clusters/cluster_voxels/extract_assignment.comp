// Writes the cluster of each voxel after the last iteration, and counts voxels without one.
#include "passes/clusters/cluster_types.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer BestSeed { uint64_t data[]; } bestSeed;
layout(scalar) writeonly buffer Assignment { uint data[]; } assignment;
buffer Unassigned { uint count; } unassigned;
layout(push_constant) uniform Push { uint count; } push;

void main() {
    const uint voxel = linearIndex();
    if (voxel >= push.count) return;
    const bool isAssigned = bestSeed.data[voxel] != ~0ul;
    assignment.data[voxel] = isAssigned ? uint(bestSeed.data[voxel] & 0xfffffffful) : NO_CLUSTER;
    if (!isAssigned) atomicAdd(unassigned.count, 1u);
}
