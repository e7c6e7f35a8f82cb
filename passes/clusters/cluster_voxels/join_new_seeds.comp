// Assigns unassigned voxels to the nearest seed that was selected in this round, and counts those without one.
#include "passes/clusters/cluster_voxels/assignment.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Coordinates { uvec3 data[]; } coordinates;
layout(scalar) readonly buffer IsNewSeed { uint data[]; } isNewSeed;
buffer Unassigned { uint count; } unassigned;

uint nearestNewSeed(uint voxel) {
    const ivec3 center = ivec3(coordinates.data[voxel]);
    ivec3 first, last;
    boxWithinReach(vec3(center) + 0.5, first, last);
    uint nearest = NO_CLUSTER;
    float minDistance = 1.0e30;
    for (BoxIterator it = voxelsInBox(first, last); nextVoxel(it);) {
        if (isNewSeed.data[it.number] == 0u) continue;
        const float cosine = dot(normals.data[it.number], normals.data[voxel]);
        if (cosine < push.minCosine) continue;
        const float distance_ = clusterDistance(vec3(it.voxel) + 0.5, center, cosine);
        if (distance_ >= minDistance) continue;
        minDistance = distance_;
        nearest = it.number;
    }
    return nearest;
}

void main() {
    const uint voxel = linearIndex();
    if (voxel >= push.count || assignment.data[voxel] != NO_CLUSTER) return;
    const uint seed = isNewSeed.data[voxel] != 0u ? voxel : nearestNewSeed(voxel);
    if (seed == NO_CLUSTER)
        atomicAdd(unassigned.count, 1u);
    else
        assignment.data[voxel] = push.seedCount + seed;
}
