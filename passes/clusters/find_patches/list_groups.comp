// Lists the surface groups of each voxel; behind the last one, where their surfels end.
#include "passes/clusters/find_patches/grouped_surfel.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer SurfelRanges { uvec2 data[]; } surfelRanges;  // First and end surfel of each voxel.
readonly buffer FirstGroup { uint data[]; } firstGroup;
layout(scalar) writeonly buffer Groups { SurfaceGroup data[]; } groups;
layout(push_constant) uniform Push {
    uint voxelCount;
    uint surfelCount;
} push;

void main() {
    const uint voxel = linearIndex();
    if (voxel > push.voxelCount) return;
    if (voxel == push.voxelCount) {
        groups.data[firstGroup.data[voxel]] = SurfaceGroup(voxel, push.surfelCount, 0u, 0u);
        return;
    }
    const uint end = surfelRanges.data[voxel].y;
    uint i = surfelRanges.data[voxel].x;
    for (uint group = firstGroup.data[voxel]; group < firstGroup.data[voxel + 1u]; ++group) {
        const GroupedSurfel first = groupedSurfels.data[i];
        groups.data[group] = SurfaceGroup(voxel, i, 0u, first.isOccluded == 1u ? GROUP_OCCLUDED : 0u);
        while (i < end && groupedSurfels.data[i].group == first.group) ++i;
    }
}
