// Computes distances of empty cells (shaders/voxel_march/distances.glsl). First the occupancy of cells, from voxels
// (OF_VOXELS) or an octree's nodes (OF_NODES); then one dispatch per axis (AXIS), each from the distances along the
// axes before.
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxel_march/distances.glsl"
#include "shaders/voxels/voxel_types.h"
layout(local_size_x = 64) in;

#if defined(OF_VOXELS)
#include "shaders/octree/octree_cells.glsl"
#include "shaders/voxel_march/bricks.glsl"
#include "shaders/voxels/voxels.glsl"
#elif defined(OF_NODES)
#include "shaders/octree/octree.glsl"
#else
readonly buffer Source { uint words[]; } source;
#endif
writeonly buffer Target { uint words[]; } target;
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    int level;
} push;

#if defined(OF_VOXELS)
// Writes the brick's occupancy as well.
uint cellWord(ivec3 cell, uint index) {
    uvec2 bits = uvec2(0u);
    uint mask = 0u;
    for (uint bit = 0u; bit < 64u; ++bit) {
        const ivec3 voxel = ivec3(bit, bit >> 2, bit >> 4) & 3;
        if (!isOccupied(push.grid, 4 * cell + voxel)) continue;
        bits[bit >> 5] |= 1u << (bit & 31u);
        mask |= 1u << octantOf(voxel >> 1);
    }
    voxelBricks.words[2u * index] = bits.x;
    voxelBricks.words[2u * index + 1u] = bits.y;
    return mask == 0u ? EMPTY_CELL_MAX_DISTANCE : mask;
}
#elif defined(OF_NODES)
uint cellWord(ivec3 cell, uint index) {
    const uint word = octree.table.data[octreeTableEntry(cell, uint(push.level))];
    return word == 0u ? EMPTY_CELL_MAX_DISTANCE : word;
}
#else
// Extends distances by one axis: to the largest d such that each of the d cells from this one on along the axis has a
// distance of d or more along the previous axes. That is the minimum over k of max(k, distance of the k-th cell).
uint cellWord(ivec3 cell, uint index) {
    uint word = source.words[index];
    if (!isCellEmpty(word)) return word;
    const ivec3 count = cellCount(push.grid.resolution, push.level), stride = ivec3(1, count.x, count.x * count.y);
    for (uint down = 0u; down < 2u; ++down) {
        const int cells = down == 1u ? cell[AXIS] : count[AXIS] - 1 - cell[AXIS],
                  step_ = down == 1u ? -stride[AXIS] : stride[AXIS];
        for (int k = 1; k <= min(MAX_DISTANCE - 1, cells); ++k) {
            const uint neighbor = source.words[uint(int(index) + k * step_)];
            for (uint i = 0u; i < 4u; ++i) {
                const uint below = i & ((1u << AXIS) - 1u), octant = below | down << AXIS | (i - below) << 1;
                const int distance_ = min(distanceOf(word, octant), max(k, distanceOf(neighbor, octant)));
                word = bitfieldInsert(word, uint(distance_), distanceShift(octant), 3);
            }
        }
    }
    return word;
}
#endif

void main() {
    const uvec3 count = uvec3(cellCount(push.grid.resolution, push.level));
    const uint i = linearIndex();
    if (i >= count.x * count.y * count.z) return;
    target.words[i] = cellWord(ivec3(i % count.x, i / count.x % count.y, i / count.x / count.y), i);
}
