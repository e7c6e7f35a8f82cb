// The surfels of all voxels, on no side yet. KEEP: where voxels have not changed, on the side that they were on. A thread takes one of
// a chunk.
#include "passes/clusters/patches.glsl"
#include "passes/clusters/find_patches/saved_side.h"
#include "shaders/compute/large_buffer.glsl"
#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/surfel_types.h"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Surfels { Surfel data[]; } surfels;
layout(scalar) readonly buffer SlotsAt { LargeUints slots; };
#ifdef KEEP
layout(scalar) readonly buffer Coordinates { uvec3 data[]; } coordinates;
readonly buffer Changed { uint words[]; } changed;  // A bit a voxel.
layout(scalar) readonly buffer SavedSidesAt { SavedSides saved; };
#endif
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint count;
    uint firstNumber;
} push;

SavedSide sideAtFirst(Surfel s) {
#ifdef KEEP
    const ivec3 voxel = ivec3(coordinates.data[s.voxel]);
    if ((changed.words[voxelWord(push.grid, voxel)] & voxelBit(push.grid, voxel)) == 0u) return saved.data[s.id];
#endif
    return SavedSide(NO_SIDE, 0.5 * push.grid.voxelSize);
}

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const Surfel s = surfels.data[i];
    const uint number = push.firstNumber + i, slot = slots.data[number];
    if (slot == NO_SIDE) return;
    const SavedSide on = sideAtFirst(s);
    patchSurfels.data[slot] =
        PatchSurfel(s.position, number, s.normal, s.id, s.reflectance, s.voxel, on.side, on.height, s.area == 0.0 ? 1u : 0u);
}
