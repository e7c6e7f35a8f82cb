// Packs surfels for lookups.
#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/packed_surfel.glsl"
#include "passes/surfels/sorted_surfels.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer SortedRef { SortedSurfelWords sorted; };
layout(scalar) readonly buffer PackedRef { PackedSurfels packed_; };
readonly buffer SurfelRanges { uvec2 data[]; } surfelRanges;
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint voxels;
} push;

// The voxel of a list. A surfel lies in it or, where its own voxel is empty, in a neighbor.
ivec3 voxelOfList(uint list, vec3 position) {
    const ivec3 voxel = voxelAt(push.grid, position);
    if (voxelNumber(push.grid, voxel) == list) return voxel;
    for (int i = 0; i < 27; ++i) {
        const ivec3 neighbor = voxel + ivec3(i % 3, (i / 3) % 3, i / 9) - 1;
        if (voxelNumber(push.grid, neighbor) == list) return neighbor;
    }
    return voxel;
}

void main() {
    const uint list = linearIndex();
    if (list >= push.voxels) return;
    const uvec2 range = surfelRanges.data[list];
    SortedSurfelWords words = sorted;
    for (uint i = range.x; i < range.y; ++i) {
        const SortedSurfel s = sortedSurfel(words, i);
        const vec3 inGrid = (s.position - push.grid.origin) / push.grid.voxelSize;
        const vec3 inVoxel = inGrid - vec3(voxelOfList(list, s.position));
        packed_.data[i] = packSurfel(inVoxel, s.normal, (s.id & VOXRAY_OCCLUDED) != 0u);
    }
}
