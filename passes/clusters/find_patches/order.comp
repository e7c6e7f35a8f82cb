// Orders each voxel's surfels by side, and counts its sides. A thread takes a voxel.
#include "passes/clusters/patches.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer Lists { uvec2 data[]; } lists;
writeonly buffer Counts { uint data[]; } counts;
layout(push_constant) uniform Push { uint voxels; } push;

void main() {
    const uint voxel = linearIndex();
    if (voxel > push.voxels) return;
    uint sides = 0u;
    if (voxel < push.voxels) {
        const uint begin = lists.data[voxel].x;
        // By insertion, which keeps the order of ids.
        for (uint i = begin; i < lists.data[voxel].y; ++i) {
            const PatchSurfel s = patchSurfels.data[i];
            uint to = i;
            for (; to > begin && patchSurfels.data[to - 1u].side > s.side; --to) patchSurfels.data[to] = patchSurfels.data[to - 1u];
            patchSurfels.data[to] = s;
        }
        for (uint i = begin; i < lists.data[voxel].y; ++i)
            if (i == begin || patchSurfels.data[i].side != patchSurfels.data[i - 1u].side) ++sides;
    }
    counts.data[voxel] = sides;  // One more than there are voxels: where the last one ends.
}
