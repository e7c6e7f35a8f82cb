#version 460
#extension GL_GOOGLE_include_directive : require
// Mean and variance of the light around each surfel, on the same surface.
#include "passes/smooth_surfels/around.glsl"

float weights = 0.0, squaredWeights = 0.0, sum = 0.0, squares = 0.0;

void visit(uint slot, float bias, float kernel) {
    const float weight = kernel * push.noise / (push.noise + bias), value = luminance(unpackRadiosity(lit.data[slot].z));
    weights += weight;
    squaredWeights += weight * weight;
    sum += weight * value;
    squares += weight * value * value;
}

void main() {
    const uint slot = linearIndex();
    if (slot >= push.count) return;
    around(slot);
    const float mean_ = sum / weights, variance = max(squares / weights - mean_ * mean_, 0.0);
    surroundings.data[slot] = Surroundings(mean_, variance, variance * squaredWeights / (weights * weights));
}
