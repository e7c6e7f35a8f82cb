// The neighbours of a surfel, as passes/radiosity/link_surfels/list_neighbours.comp lists them.
#ifndef VOXRAY_NEIGHBOURS_GLSL
#define VOXRAY_NEIGHBOURS_GLSL


// x: the neighbour's slot; y: two half floats, bias² and kernel. A vector is one load for software Vulkan.
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer NeighbourPairs { uvec2 data[]; };

const float LARGEST_BIAS = 60000.0;  // What a half float holds; such a neighbour counts for nothing.

// bias: how much the irradiance of both may differ for geometry's sake (surfel_bias.glsl), kernel: a weight that falls with distance,
// 1 to 0. Rounded by 1/2048 of themselves, at most.
uvec2 packNeighbour(uint slot, float bias, float kernel) {
    return uvec2(slot, packHalf2x16(vec2(min(bias, LARGEST_BIAS), kernel)));
}

vec2 biasAndKernel(uvec2 neighbour) { return unpackHalf2x16(neighbour.y); }

#endif
