// Voxels that no cluster asked for join that of the nearest voxel that has one, whatever their normals (Cosin and Patow 2022, figure
// 9). A thread takes a voxel.
#include "passes/clusters/cluster_voxels/owners.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Coordinates { uvec3 data[]; } coordinates;
layout(scalar) writeonly buffer Joined { uint data[]; } joined;

// Shells of growing boxes round the voxel. A shell's nearest voxel may be as far as its corner, so the search goes on to there.
uint nearestOwner(ivec3 center) {
    const int farthest = int(max(push.grid.resolution.x, max(push.grid.resolution.y, push.grid.resolution.z)));
    uint best = NO_CLUSTER;
    float nearest = 1.0e30;
    for (int shell = 1; shell <= farthest && float(shell) * float(shell) <= nearest; ++shell)
        for (int z = -shell; z <= shell; ++z)
            for (int y = -shell; y <= shell; ++y) {
                const bool isWhole = abs(z) == shell || abs(y) == shell;
                for (int x = -shell; x <= shell; x += isWhole ? 1 : 2 * shell) {
                    const vec3 away = vec3(x, y, z);
                    if (dot(away, away) > nearest) continue;
                    const uint number = voxelNumber(push.grid, center + ivec3(x, y, z));
                    if (number == NO_VOXEL || owners.data[number] == NO_CLUSTER) continue;
                    // Of voxels as near the one whose cluster came first.
                    if (dot(away, away) == nearest && owners.data[number] >= best) continue;
                    nearest = dot(away, away);
                    best = owners.data[number];
                }
            }
    return best;
}

void main() {
    const uint voxel = linearIndex();
    if (voxel >= push.count) return;
    const uint owner = owners.data[voxel];
    joined.data[voxel] = owner == NO_CLUSTER ? nearestOwner(ivec3(coordinates.data[voxel])) : owner;
}
