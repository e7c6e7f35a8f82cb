// Mean and variance of the irradiance around each surfel.
#include "shaders/scene/sampling.glsl"
#include "passes/surfels/smooth_surfels/neighborhoods.glsl"

float weights, squaredWeights, sum, squares;

void add(float weight, uint irradiance) {
    const float value = luminance(unpackRadiosity(irradiance));
    weights += weight;
    squaredWeights += weight * weight;
    sum += weight * value;
    squares += weight * value * value;
}

void main() {
    const uint surfel = linearIndex();
    if (surfel >= push.count) return;
    weights = 0.0, squaredWeights = 0.0, sum = 0.0, squares = 0.0;
    const uint irradiance = lit.data[surfel].z, end = begins.data[surfel + 1u];
    add(1.0, irradiance);
    for (uint i = begins.data[surfel]; i < end; ++i) {
        const uvec2 neighbor = pairs.data[i];
        const vec2 pair = biasAndKernel(neighbor);
        add(pair.y * push.noise / (push.noise + pair.x), lit.data[neighbor.x].z);
    }
    const float mean_ = sum / weights, variance = max(squares / weights - mean_ * mean_, 0.0);
    const float varianceOfMean = variance * squaredWeights / (weights * weights);
    neighborhoods.data[surfel] = uvec4(floatBitsToUint(vec3(mean_, variance, varianceOfMean)), irradiance);
}
