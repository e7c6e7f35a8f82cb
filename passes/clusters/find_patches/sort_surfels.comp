// Sorts each voxel's surfels by group, and counts its groups.
#include "passes/clusters/find_patches/grouped_surfel.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer SurfelRanges { uvec2 data[]; } surfelRanges;    // First and end surfel of each voxel.
writeonly buffer Counts { uint data[]; } counts;  // Per voxel, then 0 for the prefix sum.
layout(push_constant) uniform Push { uint voxelCount; } push;

void main() {
    const uint voxel = linearIndex();
    if (voxel > push.voxelCount) return;
    uint groups = 0u;
    if (voxel < push.voxelCount) {
        const uint first = surfelRanges.data[voxel].x, end = surfelRanges.data[voxel].y;
        // Insertion sort is stable: within a group surfels stay sorted by id
        for (uint i = first; i < end; ++i) {
            const GroupedSurfel s = groupedSurfels.data[i];
            uint target = i;
            for (; target > first && groupedSurfels.data[target - 1u].group > s.group; --target)
                groupedSurfels.data[target] = groupedSurfels.data[target - 1u];
            groupedSurfels.data[target] = s;
        }
        for (uint i = first; i < end; ++i)
            if (i == first || groupedSurfels.data[i].group != groupedSurfels.data[i - 1u].group) ++groups;
    }
    counts.data[voxel] = groups;
}
