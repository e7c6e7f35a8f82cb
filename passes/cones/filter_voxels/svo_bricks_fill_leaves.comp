// Fills the bricks of leaves: the first dispatch finds the brightest value, the second writes the values. All 27 of a
// leaf are the voxel's until transfers average them with the neighbors'. Neighbors without surfaces are transparent and
// black.
#include "shaders/compute/linear_index.glsl"
#include "passes/cones/radiance/radiance_voxels.glsl"
#include "passes/cones/radiance/surface_radiance.glsl"
layout(local_size_x = 64) in;

layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    float emission;
    LevelNodes nodes;
    uint scaleIsKnown;  // 0: find the brightest value; 1: write values.
} push;

void main() {
    if (linearIndex() >= nodesOf(push.nodes)) return;
    const BrickNode node = radianceVoxels.nodes.data[levelNode(push.nodes, linearIndex())];
    if (node.brick == NO_BRICK) return;
    const uint voxel = voxelNumber(push.grid, unpackCell(node.cell));
    vec4 value = voxel == NO_VOXEL ? vec4(0.0) : meanRadiance(push.grid, voxel, push.emission);
    const float largest = max(value.r, max(value.g, value.b));
    if (push.scaleIsKnown == 0u) {
        // Bits of positive floats have the order of the floats.
        if (floatBitsToUint(largest) > radianceVoxels.scale.brightest)
            atomicMax(radianceVoxels.scale.brightest, floatBitsToUint(largest));
        return;
    }
    if (largest > 0.0) value.rgb /= uintBitsToFloat(radianceVoxels.scale.brightest);
    for (int i = 0; i < int(BRICK_VALUES); ++i) storeBrickValue(node.brick, ivec3(i % 3, i / 3 % 3, i / 9), value);
}
