// Of each voxel's open surfels that are on no side yet, or of its covered ones, the first begins one. A thread takes a voxel.
#include "passes/clusters/patches.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer Lists { uvec2 data[]; } lists;
writeonly buffer Pivots { uint data[]; } pivots;
buffer Left { uint count; } left;  // Voxels that have such surfels.
layout(push_constant) uniform Push {
    uint voxels;
    uint round;
    uint isCovered;  // Which surfels.
} push;

void main() {
    const uint voxel = linearIndex();
    if (voxel >= push.voxels) return;
    for (uint i = lists.data[voxel].x; i < lists.data[voxel].y; ++i) {
        if (patchSurfels.data[i].side != NO_SIDE || patchSurfels.data[i].isCovered != push.isCovered) continue;
        patchSurfels.data[i].side = push.round;
        pivots.data[voxel] = i;
        atomicAdd(left.count, 1u);
        return;
    }
}
