// What both steps of an iteration read: the neighbors of each surfel, its irradiance, and the moments of its
// neighborhood.
#ifndef VOXRAY_NEIGHBORHOODS_GLSL
#define VOXRAY_NEIGHBORHOODS_GLSL

#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/neighbors.glsl"
#include "passes/surfels/radiosity.glsl"
#include "passes/surfels/smooth_surfels/smooth_nodes.glsl"
#include "passes/surfels/surfel_bias.glsl"
layout(local_size_x = 64) in;

// Of the luminance of irradiance around a surfel, the bits of its mean (W/m²), of the variance of one surfel, and of the
// variance of the mean and the surfel's inverse distance (16 bits each); w: the surfel's irradiance, packed. A struct
// would be one load per member on software Vulkan.
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer Neighborhoods { uvec4 data[]; };

readonly buffer Ranges { uvec2 data[]; } ranges;  // By node.
layout(scalar) readonly buffer PairsRef { NeighborPairs pairs; };
layout(scalar) readonly buffer NodesRef { SmoothNodes nodes; };
layout(scalar) readonly buffer NeighborhoodsRef { Neighborhoods neighborhoods; };
layout(push_constant) uniform Push {
    uint count;
    float noise;          // Relative variance of a surfel's irradiance, roughly.
    float squaredRadius;  // Of neighborhoods, voxels².
} push;

// Two floats, not negative, in 32 bits: their upper halves, rounded to nearest by 1/512 of their values, at most.
uint packUpperHalves(float a, float b) {
    return ((floatBitsToUint(a) + 0x8000u) & 0xffff0000u) | (floatBitsToUint(b) + 0x8000u) >> 16;
}
float upperHalf(uint bits) { return uintBitsToFloat(bits & 0xffff0000u); }
float lowerHalf(uint bits) { return uintBitsToFloat(bits << 16); }

// Weight of a neighbor for its distance, from 1 to 0; and by how much its irradiance may differ.
struct Neighbor {
    float kernel;
    float bias;
};

// `inverseA`, `inverseB`: the inverse distances of both surfels, 1/voxel.
Neighbor neighborOf(uvec2 pair, float inverseA, float inverseB) {
    const vec2 p = biasAndSquaredDistance(pair);
    return Neighbor(1.0 - p.y, p.x + distanceBias(p.y * push.squaredRadius, 0.5 * (inverseA + inverseB)));
}

#endif
