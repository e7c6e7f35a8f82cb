// Writes the bricks of leaves; the first pass finds the brightest leaf. A leaf is one voxel of light, so all 27 values
// of its brick are equal until neighbors are averaged in. Leaves with surfaces are opaque; neighbors that exist without
// surfaces are transparent and black.
#include "passes/published/arneback_2017/light_octree/leaf_sums.glsl"
#include "shaders/compute/linear_index.glsl"
#include "passes/cones/radiance/radiance_voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) buffer LeafRadianceRef { LeafRadiance leaves; };
layout(push_constant, scalar) uniform Push {
    LevelNodes nodes;
    uint isWriting;  // 0: finds the brightest leaf; 1: writes values.
} push;

void main() {
    const uint i = linearIndex();
    if (i >= nodesOf(push.nodes)) return;
    const BrickNode node = radianceVoxels.nodes.data[levelNode(push.nodes, i)];
    if (node.brick == NO_BRICK) return;
    vec4 value = node.color == 0u ? vec4(0.0) : vec4(leaves.data[i], 1.0);
    const uint largest = floatBitsToUint(max(value.r, max(value.g, value.b)));
    if (push.isWriting == 0u) {
        if (largest > radianceVoxels.scale.brightest) atomicMax(radianceVoxels.scale.brightest, largest);
        return;
    }
    if (largest > 0u) value.rgb /= uintBitsToFloat(radianceVoxels.scale.brightest);
    for (int valueIndex = 0; valueIndex < int(BRICK_VALUES); ++valueIndex)
        storeBrickValue(node.brick, ivec3(valueIndex % 3, valueIndex / 3 % 3, valueIndex / 9), value);
}
