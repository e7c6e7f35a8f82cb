// Writes the surfels of a chunk, sorted by voxel, without a group. UPDATE: those of unchanged voxels get their
// previous one.
#include "passes/clusters/find_patches/grouped_surfel.h"
#include "passes/clusters/find_patches/stored_group.h"
#include "shaders/compute/large_buffer.glsl"
#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/surfel_types.h"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Surfels { Surfel data[]; } surfels;
layout(scalar) readonly buffer SortedIndicesRef { LargeUints sortedIndices; };
#ifdef UPDATE
layout(scalar) readonly buffer Coordinates { uvec3 data[]; } coordinates;
readonly buffer Changed { uint words[]; } changed;  // A bit for each voxel.
layout(scalar) readonly buffer StoredGroupsRef { StoredGroups storedGroups; };
#endif
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint count;
    uint firstIndex;  // Index of the chunk's first surfel in the surfels of all chunks.
} push;

StoredGroup initialGroup(Surfel s) {
#ifdef UPDATE
    const ivec3 voxel = ivec3(coordinates.data[s.voxel]);
    if ((changed.words[voxelWord(push.grid, voxel)] & voxelBit(push.grid, voxel)) == 0u) return storedGroups.data[s.id];
#endif
    return StoredGroup(NO_GROUP, 0.5 * push.grid.voxelSize);
}

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const Surfel s = surfels.data[i];
    if (s.voxel == NO_VOXEL) return;
    const StoredGroup initial = initialGroup(s);
    groupedSurfels.data[sortedIndices.data[push.firstIndex + i]] =
        GroupedSurfel(s.position, s.id, s.normal, s.voxel, s.reflectance, initial.group, initial.height,
                      s.area == 0.0 ? 1u : 0u);
}
