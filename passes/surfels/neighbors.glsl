// Neighbors of surfels, as passes/radiosity/link_surfels/neighborhood.glsl lists them.
#ifndef VOXRAY_NEIGHBORS_GLSL
#define VOXRAY_NEIGHBORS_GLSL

// x: the neighbor's node (SurfelNeighbors); y: bias² and squared distance as half floats. A vector is one load for
// software Vulkan.
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer NeighborPairs { uvec2 data[]; };

const float LARGEST_BIAS = 60000.0;  // Fits a half float; such a neighbor gets next to no weight.

// `bias`: by how much the irradiance of both may differ for their places and normals (surfelBias()).
// `squaredDistance`: in units of the squared radius, 0 to 1. Both are rounded by 1/2048 of their values, at most.
uvec2 packNeighbor(uint node, float bias, float squaredDistance) {
    return uvec2(node, packHalf2x16(vec2(min(bias, LARGEST_BIAS), squaredDistance)));
}

vec2 biasAndSquaredDistance(uvec2 neighbor) { return unpackHalf2x16(neighbor.y); }

#endif
