// Each voxel's cluster out of what the last iteration found; counts the voxels that no cluster asked for.
#include "passes/clusters/cluster_types.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Nearest { uint64_t data[]; } nearest;
layout(scalar) writeonly buffer Owners { uint data[]; } owners;
buffer Unassigned { uint count; } unassigned;
layout(push_constant) uniform Push { uint count; } push;

void main() {
    const uint voxel = linearIndex();
    if (voxel >= push.count) return;
    const bool isAssigned = nearest.data[voxel] != ~0ul;
    owners.data[voxel] = isAssigned ? uint(nearest.data[voxel] & 0xfffffffful) : NO_CLUSTER;
    if (!isAssigned) atomicAdd(unassigned.count, 1u);
}
