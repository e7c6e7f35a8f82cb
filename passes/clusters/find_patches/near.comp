// Sides of the 26 voxels round each side that look some way that it looks: counts them. LIST: lists them, with whose they are. A thread
// takes a side.
#include "passes/clusters/patches.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Coordinates { uvec3 data[]; } coordinates;
layout(scalar) readonly buffer Sides { SurfaceSide data[]; } sides;
readonly buffer FirstSide { uint data[]; } firstSide;
layout(scalar) readonly buffer SideMaterialsAt { VoxelMaterials sideMaterials; };
#ifdef LIST
readonly buffer FirstNeighbour { uint data[]; } firstNeighbour;
layout(scalar) readonly buffer NeighboursAt { LargeUints neighbours; };
layout(scalar) readonly buffer WhoseAt { LargeUints whose; };
#else
writeonly buffer Counts { uint data[]; } counts;
#endif
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint sideCount;
} push;

bool haveFaceInCommon(VoxelMaterial a, VoxelMaterial b) {
    const vec3 both = min(a.unoccludedPositive, b.unoccludedPositive) + min(a.unoccludedNegative, b.unoccludedNegative);
    return any(greaterThan(both, vec3(0.0)));
}

void main() {
    const uint side = linearIndex();
    if (side > push.sideCount) return;
    uint count = 0u;
    if (side < push.sideCount) {
        const VoxelMaterial m = unpackMaterial(sideMaterials.data[side]);
        const ivec3 center = ivec3(coordinates.data[sides.data[side].voxel]);
        for (int i = 0; i < 27; ++i) {
            const uint voxel = voxelNumber(push.grid, center + ivec3(i % 3, i / 3 % 3, i / 9) - 1);
            if (i == 13 || voxel == NO_VOXEL) continue;
            for (uint other = firstSide.data[voxel]; other < firstSide.data[voxel + 1u]; ++other) {
                if (sides.data[other].isCovered != sides.data[side].isCovered) continue;
                if (!haveFaceInCommon(m, unpackMaterial(sideMaterials.data[other]))) continue;
#ifdef LIST
                neighbours.data[firstNeighbour.data[side] + count] = other;
                whose.data[firstNeighbour.data[side] + count] = side;
#endif
                ++count;
            }
        }
    }
#ifndef LIST
    counts.data[side] = count;  // One more than there are sides: where the last one ends.
#endif
}
