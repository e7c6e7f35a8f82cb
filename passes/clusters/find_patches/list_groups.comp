// Lists the surface groups of each voxel and stores the sorted index of each of their surfels.
#include "passes/clusters/grouped_surfels.glsl"
#include "shaders/compute/large_buffer.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer SurfelRanges { uvec2 data[]; } surfelRanges;  // First and end surfel of each voxel.
readonly buffer FirstGroup { uint data[]; } firstGroup;
layout(scalar) readonly buffer SurfelIndexRef { LargeUints surfelIndex; };
layout(scalar) writeonly buffer Groups { SurfaceGroup data[]; } groups;
layout(push_constant) uniform Push { uint voxels; } push;

void main() {
    const uint voxel = linearIndex();
    if (voxel >= push.voxels) return;
    const uint end = surfelRanges.data[voxel].y;
    uint i = surfelRanges.data[voxel].x;
    for (uint group = firstGroup.data[voxel]; group < firstGroup.data[voxel + 1u]; ++group) {
        const uint first = i, groupInVoxel = groupedSurfels.data[i].group;
        for (; i < end && groupedSurfels.data[i].group == groupInVoxel; ++i) {
            groupedSurfels.data[i].group = group;
            surfelIndex.data[groupedSurfels.data[i].index] = i;
        }
        const GroupedSurfel s = groupedSurfels.data[first];
        groups.data[group] = SurfaceGroup(pointAbove(s), voxel, first, i - first, s.isOccluded, 0u, 0u);
    }
}
