// Converts fixed-point sums to watts.
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/flux_accumulator.glsl"
#include "shaders/voxels/packed_flux.glsl"
layout(local_size_x = 64) in;

layout(scalar) buffer FluxRef { LargeUints flux; };
layout(push_constant) uniform Push {
    uint pairs;
    float wattsPerUnit;
} push;

vec3 watts(uint face) {
    const uint first = 3u * face;
    return vec3(fluxAccumulator.data[first], fluxAccumulator.data[first + 1u], fluxAccumulator.data[first + 2u]) *
           push.wattsPerUnit;
}

void main() {
    const uint pair = linearIndex();
    if (pair < push.pairs) storeFlux(flux, pair, watts(2u * pair), watts(2u * pair + 1u));
}
