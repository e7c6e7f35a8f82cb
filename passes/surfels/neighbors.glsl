// Neighbors of surfels, as passes/radiosity/link_surfels/list_neighbors.comp lists them.
#ifndef VOXRAY_NEIGHBORS_GLSL
#define VOXRAY_NEIGHBORS_GLSL

// x: the neighbor's index in SurfelsByVoxel::sorted; y: bias² and kernel as half floats. A vector is one load for
// software Vulkan.
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer NeighborPairs { uvec2 data[]; };

const float LARGEST_BIAS = 60000.0;  // Fits a half float; such a neighbor gets next to no weight.

// `bias`: by how much the irradiance of both may differ for their geometry (surfel_bias.glsl). `kernel`: weight that
// falls with distance from 1 to 0. Both are rounded by 1/2048 of their values, at most.
uvec2 packNeighbor(uint index, float bias, float kernel) {
    return uvec2(index, packHalf2x16(vec2(min(bias, LARGEST_BIAS), kernel)));
}

vec2 biasAndKernel(uvec2 neighbor) { return unpackHalf2x16(neighbor.y); }

#endif
