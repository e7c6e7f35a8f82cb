// Adds the radiance of leaves that one light causes to that of others.
#include "passes/published/arneback_2017/light_octree/leaf_sums.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) buffer LeafRadianceRef { LeafRadiance leaves; };
readonly buffer Brightest { uint bits; } brightest;
layout(push_constant) uniform Push { uint leaves; } push;

void main() {
    const uint i = linearIndex();
    if (i >= push.leaves) return;
    const LeafSum sum = sums.data[i];
    if (sum.texels == 0u) return;
    const vec3 mean = vec3(sum.radiance[0], sum.radiance[1], sum.radiance[2]);
    leaves.data[i] += uintBitsToFloat(brightest.bits) / kFixedPointOne * mean;
}
