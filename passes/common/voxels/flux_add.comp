#version 460
#extension GL_GOOGLE_include_directive : require
// Adds the flux of voxels' faces to what they hold.
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/packed_flux.glsl"
layout(local_size_x = 64) in;

layout(scalar) buffer AddedAt { LargeUints added; };
layout(scalar) buffer SumAt { LargeUints sum; };
layout(push_constant) uniform Push { uint count; } push;  // Pairs of faces.

void main() {
    const uint pair = linearIndex();
    if (pair >= push.count) return;
    storeFlux(sum, pair, loadFlux(sum, 2u * pair) + loadFlux(added, 2u * pair),
              loadFlux(sum, 2u * pair + 1u) + loadFlux(added, 2u * pair + 1u));
}
