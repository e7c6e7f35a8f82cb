// Assigns unassigned voxels to the cluster of the nearest assigned voxel (Cosin and Patow 2022, figure 9).
#include "passes/clusters/cluster_voxels/assignment.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Coordinates { uvec3 data[]; } coordinates;
layout(scalar) writeonly buffer NewAssignment { uint data[]; } newAssignment;

// Searches shells of growing boxes until the faces of a shell are farther than the nearest voxel found.
uint nearestCluster(ivec3 center) {
    const int maxShell = int(max(push.grid.resolution.x, max(push.grid.resolution.y, push.grid.resolution.z)));
    uint nearest = NO_CLUSTER;
    float minDistance2 = 1.0e30;
    for (int shell = 1; shell <= maxShell && float(shell) * float(shell) <= minDistance2; ++shell)
        for (int z = -shell; z <= shell; ++z)
            for (int y = -shell; y <= shell; ++y) {
                const bool isFullRow = abs(z) == shell || abs(y) == shell;
                for (int x = -shell; x <= shell; x += isFullRow ? 1 : 2 * shell) {
                    const vec3 offset = vec3(x, y, z);
                    const float distance2 = dot(offset, offset);
                    if (distance2 > minDistance2) continue;
                    const uint voxel = voxelNumber(push.grid, center + ivec3(x, y, z));
                    if (voxel == NO_VOXEL || assignment.data[voxel] == NO_CLUSTER) continue;
                    // Among equally near voxels, use the one with the lowest cluster
                    if (distance2 == minDistance2 && assignment.data[voxel] >= nearest) continue;
                    minDistance2 = distance2;
                    nearest = assignment.data[voxel];
                }
            }
    return nearest;
}

void main() {
    const uint voxel = linearIndex();
    if (voxel >= push.count) return;
    const uint cluster = assignment.data[voxel];
    newAssignment.data[voxel] = cluster == NO_CLUSTER ? nearestCluster(ivec3(coordinates.data[voxel])) : cluster;
}
