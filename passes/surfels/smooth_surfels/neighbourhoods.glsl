// What both steps of an iteration read: the neighbours of each surfel, the light, and what is around it.
#ifndef VOXRAY_SURROUNDINGS_GLSL
#define VOXRAY_SURROUNDINGS_GLSL

#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/neighbours.glsl"
#include "passes/surfels/packed_surfel.glsl"
#include "passes/surfels/radiosity.glsl"
layout(local_size_x = 64) in;

// Of the light around a surfel, in one vector (a struct would be a load for each member on software Vulkan): the bits of three floats,
// the mean luminance of irradiance, W/m², its variance of a single surfel, and the variance of the mean; the surfel's own irradiance.
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer AllSurroundings { uvec4 data[]; };

readonly buffer Begins { uint data[]; } begins;  // Of each surfel's neighbours, by slot.
layout(scalar) readonly buffer PairsRef { NeighbourPairs pairs; };
layout(scalar) readonly buffer LitRef { LitSurfels lit; };
layout(scalar) readonly buffer SurroundingsRef { AllSurroundings surroundings; };
layout(push_constant) uniform Push {
    uint count;
    float noise;  // Relative variance of a surfel's irradiance, roughly.
} push;

#endif
