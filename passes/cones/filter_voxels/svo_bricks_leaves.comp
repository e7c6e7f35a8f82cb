// Light into the bricks of leaves: first the brightest of all, then the values. A thread takes a leaf. What surfaces of a voxel send
// is one value, so all 27 of its brick are that until the neighbours' are averaged in. Neighbours that were made to exist are
// transparent and black.
#include "shaders/compute/linear_index.glsl"
#include "passes/cones/radiance/radiance_voxels.glsl"
#include "passes/cones/radiance/surface_radiance.glsl"
layout(local_size_x = 64) in;

layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    float emission;
    LevelNodes nodes;
    uint isMeasured;  // 0: the brightest is looked for; 1: it is known.
} push;

void main() {
    if (linearIndex() >= nodesOf(push.nodes)) return;
    const BrickNode node = radianceVoxels.nodes.data[levelNode(push.nodes, linearIndex())];
    if (node.brick == NO_BRICK) return;
    const uint voxel = voxelNumber(push.grid, unpackCell(node.cell));
    vec4 value = voxel == NO_VOXEL ? vec4(0.0) : meanRadiance(push.grid, voxel, push.emission);
    const float largest = max(value.r, max(value.g, value.b));
    if (push.isMeasured == 0u) {
        // As floats above 0 are ordered, so are their bits
        if (floatBitsToUint(largest) > radianceVoxels.scale.brightest)
            atomicMax(radianceVoxels.scale.brightest, floatBitsToUint(largest));
        return;
    }
    if (largest > 0.0) value.rgb /= uintBitsToFloat(radianceVoxels.scale.brightest);
    for (int i = 0; i < int(BRICK_VALUES); ++i) storeBrickValue(node.brick, ivec3(i % 3, i / 3 % 3, i / 9), value);
}
