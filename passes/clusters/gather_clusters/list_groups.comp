// Lists the unoccluded surface groups of the new voxels, in any order.
#include "passes/clusters/group_patches.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer NewVoxels { uint data[]; } newVoxels;
readonly buffer FirstGroup { uint data[]; } firstGroup;
layout(scalar) readonly buffer Groups { SurfaceGroup data[]; } groups;
writeonly buffer IsListed { uint data[]; } isListed;  // Per group.
writeonly buffer ListedGroups { uint data[]; } listedGroups;
buffer Count { uint value; } count;
layout(push_constant) uniform Push { uint voxels; } push;

void main() {
    const uint i = linearIndex();
    if (i >= push.voxels) return;
    const uint voxel = newVoxels.data[i];
    for (uint group = firstGroup.data[voxel]; group < firstGroup.data[voxel + 1u]; ++group) {
        if (isOccluded(groups.data[group])) continue;
        isListed.data[group] = 1u;
        listedGroups.data[atomicAdd(count.value, 1u)] = group;
    }
}
