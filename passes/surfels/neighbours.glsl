// Neighbours of surfels, as passes/radiosity/link_surfels/list_neighbours.comp lists them.
#ifndef VOXRAY_NEIGHBOURS_GLSL
#define VOXRAY_NEIGHBOURS_GLSL

// x: the neighbour's index in SurfelsByVoxel::sorted; y: bias² and kernel as half floats. A vector is one load for
// software Vulkan.
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer NeighbourPairs { uvec2 data[]; };

const float LARGEST_BIAS = 60000.0;  // Fits a half float; such a neighbour gets next to no weight.

// `bias`: by how much the irradiance of both may differ for their geometry (surfel_bias.glsl). `kernel`: weight that
// falls with distance from 1 to 0. Both are rounded by 1/2048 of their values, at most.
uvec2 packNeighbour(uint index, float bias, float kernel) {
    return uvec2(index, packHalf2x16(vec2(min(bias, LARGEST_BIAS), kernel)));
}

vec2 biasAndKernel(uvec2 neighbour) { return unpackHalf2x16(neighbour.y); }

#endif
