// What both steps of an iteration read: the neighbors of each surfel, its irradiance, and the moments of its
// neighborhood.
#ifndef VOXRAY_NEIGHBORHOODS_GLSL
#define VOXRAY_NEIGHBORHOODS_GLSL

#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/neighbors.glsl"
#include "passes/surfels/packed_surfel.glsl"
#include "passes/surfels/radiosity.glsl"
layout(local_size_x = 64) in;

// xyz: of the luminance of irradiance around a surfel, the bits of its mean (W/m²), the variance of one surfel and the
// variance of the mean; w: the surfel's irradiance, packed. A struct would be one load per member on software Vulkan.
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer Neighborhoods { uvec4 data[]; };

readonly buffer Begins { uint data[]; } begins;  // By surfel: its first pair.
layout(scalar) readonly buffer PairsRef { NeighborPairs pairs; };
layout(scalar) readonly buffer LitRef { LitSurfels lit; };
layout(scalar) readonly buffer NeighborhoodsRef { Neighborhoods neighborhoods; };
layout(push_constant) uniform Push {
    uint count;
    float noise;  // Relative variance of a surfel's irradiance, roughly.
} push;

#endif
