// Mean and variance of the light around each surfel, on the same surface.
#include "shaders/scene/sampling.glsl"
#include "passes/surfels/smooth_surfels/neighbourhoods.glsl"

float weights, squaredWeights, sum, squares;

void add(float weight, uint irradiance) {
    const float value = luminance(unpackRadiosity(irradiance));
    weights += weight;
    squaredWeights += weight * weight;
    sum += weight * value;
    squares += weight * value * value;
}

void main() {
    const uint slot = linearIndex();
    if (slot >= push.count) return;
    weights = 0.0, squaredWeights = 0.0, sum = 0.0, squares = 0.0;
    const uint own = lit.data[slot].z, end = begins.data[slot + 1u];
    add(1.0, own);
    for (uint i = begins.data[slot]; i < end; ++i) {
        const uvec2 neighbour = pairs.data[i];
        const vec2 pair = biasAndKernel(neighbour);
        add(pair.y * push.noise / (push.noise + pair.x), lit.data[neighbour.x].z);
    }
    const float mean_ = sum / weights, variance = max(squares / weights - mean_ * mean_, 0.0);
    surroundings.data[slot] = uvec4(
        floatBitsToUint(vec3(mean_, variance, variance * squaredWeights / (weights * weights))), own);
}
