// Of the voxels that no cluster asked for: those that begin a cluster of their own in this round. A voxel does where no other one in
// reach and within the angle limit comes before it in a random order (a maximal independent set, Luby 1986). A thread takes a voxel.
#include "passes/clusters/cluster_voxels/owners.glsl"
#include "shaders/scene/sampling.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Coordinates { uvec3 data[]; } coordinates;
layout(scalar) writeonly buffer Leads { uint data[]; } leads;

// Hashes of different numbers differ: lowbias32 is a bijection.
bool comesBefore(uint a, uint b) { return hash(a) < hash(b); }

bool isFirst(uint voxel) {
    ivec3 first, last;
    boxWithinReach(vec3(coordinates.data[voxel]) + 0.5, first, last);
    for (BoxWalk w = walkBox(first, last); nextVoxel(w);) {
        if (w.number == voxel || owners.data[w.number] != NO_CLUSTER || !comesBefore(w.number, voxel)) continue;
        if (dot(normals.data[w.number], normals.data[voxel]) >= push.minCosine) return false;
    }
    return true;
}

void main() {
    const uint voxel = linearIndex();
    if (voxel >= push.count) return;
    leads.data[voxel] = owners.data[voxel] == NO_CLUSTER && isFirst(voxel) ? 1u : 0u;
}
