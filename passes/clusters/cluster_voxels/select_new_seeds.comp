// Selects new seeds among the unassigned voxels by one round of Luby's algorithm (1986), which finds a maximal
// independent set. Voxels within reach of each other and within the angle limit are neighbors; a voxel is selected if
// it is before all its neighbors in a random order.
#include "passes/clusters/cluster_voxels/assignment.glsl"
#include "shaders/scene/sampling.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Coordinates { uvec3 data[]; } coordinates;
layout(scalar) writeonly buffer IsNewSeed { uint data[]; } isNewSeed;

// The hash, lowbias32, is a bijection: there are no equal hashes.
bool comesBefore(uint a, uint b) { return hash(a) < hash(b); }

bool comesFirst(uint voxel) {
    ivec3 first, last;
    boxWithinReach(vec3(coordinates.data[voxel]) + 0.5, first, last);
    for (BoxIterator it = voxelsInBox(first, last); nextVoxel(it);) {
        if (assignment.data[it.number] != NO_CLUSTER || !comesBefore(it.number, voxel)) continue;
        if (dot(normals.data[it.number], normals.data[voxel]) >= push.minCosine) return false;
    }
    return true;
}

void main() {
    const uint voxel = linearIndex();
    if (voxel >= push.count) return;
    isNewSeed.data[voxel] = assignment.data[voxel] == NO_CLUSTER && comesFirst(voxel) ? 1u : 0u;
}
