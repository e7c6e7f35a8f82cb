#version 460
#extension GL_GOOGLE_include_directive : require
// Irradiance of each surfel as the mean of those around it. Each counts by
//
//     noise / (noise + bias²)
//
// as in filter_irradiance. noise: variance of a surfel, the mean of both, so that a pair has one weight.
// bias²: what geometry allows the two to differ by, and what the means of their surroundings do differ by beyond their noise.
#include "passes/smooth_surfels/around.glsl"

layout(scalar) readonly buffer ResultAt { LitSurfels result; };

Surroundings own;
vec3 sum = vec3(0.0);
float weights = 0.0;

void visit(uint slot, float bias, float kernel) {
    const Surroundings other = surroundings.data[slot];
    const float mean_ = 0.5 * (own.mean + other.mean), noise = 0.5 * (own.variance + other.variance);
    const float apart = own.mean - other.mean;
    const float bias2 = bias * mean_ * mean_ + max(apart * apart - own.ofMean - other.ofMean, 0.0);
    const float weight = kernel * (bias2 > 0.0 ? noise / max(noise + bias2, 1e-30) : 1.0);
    sum += weight * unpackRadiosity(lit.data[slot].z);
    weights += weight;
}

void main() {
    const uint slot = linearIndex();
    if (slot >= push.count) return;
    own = surroundings.data[slot];
    around(slot);
    result.data[slot] = uvec3(lit.data[slot].xy, packRadiosity(sum / weights));
}
