// Voxels without a cluster join the nearest of those that begin one in this round; counts who is left. A thread takes a voxel.
#include "passes/clusters/cluster_voxels/owners.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Coordinates { uvec3 data[]; } coordinates;
layout(scalar) readonly buffer Leads { uint data[]; } leads;
buffer Unassigned { uint count; } unassigned;

uint nearestLead(uint voxel) {
    const ivec3 own = ivec3(coordinates.data[voxel]);
    ivec3 first, last;
    boxWithinReach(vec3(own) + 0.5, first, last);
    uint best = NO_CLUSTER;
    float nearest = 1.0e30;
    for (BoxWalk w = walkBox(first, last); nextVoxel(w);) {
        if (leads.data[w.number] == 0u) continue;
        const float cosine = dot(normals.data[w.number], normals.data[voxel]);
        if (cosine < push.minCosine) continue;
        const float away = clusterDistance(vec3(w.voxel) + 0.5, own, cosine);
        if (away >= nearest) continue;
        nearest = away;
        best = w.number;
    }
    return best;
}

void main() {
    const uint voxel = linearIndex();
    if (voxel >= push.count || owners.data[voxel] != NO_CLUSTER) return;
    const uint lead = leads.data[voxel] != 0u ? voxel : nearestLead(voxel);
    if (lead == NO_CLUSTER)
        atomicAdd(unassigned.count, 1u);
    else
        owners.data[voxel] = push.firstOwn + lead;
}
