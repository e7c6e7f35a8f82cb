// Sorts each voxel's surfels by id, so that sums over them are the same in every run, and inverts the permutation.
#include "shaders/compute/large_buffer.glsl"
#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/sorted_surfels.h"
layout(local_size_x = 64) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer SortedSurfels { SortedSurfel data[]; };
layout(scalar) readonly buffer SortedRef { SortedSurfels sorted; };
layout(scalar) readonly buffer SortedIndicesRef { LargeUints sortedIndices; };
readonly buffer Begins { uint data[]; } begins;
readonly buffer Ends { uint data[]; } ends;
writeonly buffer SurfelRanges { uvec2 data[]; } surfelRanges;
layout(push_constant) uniform Push { uint voxels; } push;

void main() {
    const uint voxel = linearIndex();
    if (voxel >= push.voxels) return;
    const uint begin = begins.data[voxel], end = ends.data[voxel];
    surfelRanges.data[voxel] = uvec2(begin, end);
    // Insertion sort: lists are short
    for (uint i = begin; i < end; ++i) {
        const SortedSurfel s = sorted.data[i];
        uint to = i;
        for (; to > begin && sorted.data[to - 1u].id > s.id; --to) sorted.data[to] = sorted.data[to - 1u];
        sorted.data[to] = s;
    }
    for (uint i = begin; i < end; ++i) sortedIndices.data[sorted.data[i].index] = i;
}
