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
    const uint node = linearIndex();
    if (node >= push.count) return;
    weights = 0.0, squaredWeights = 0.0, sum = 0.0, squares = 0.0;
    const uvec2 range = ranges.data[node], center = nodes.data[node];
    const float inverse = uintBitsToFloat(center.x);
    add(1.0, center.y);
    for (uint i = range.x; i < range.y; ++i) {
        const uvec2 pair = pairs.data[i], other = nodes.data[pair.x];
        const Neighbor n = neighborOf(pair, inverse, uintBitsToFloat(other.x));
        add(n.kernel * push.noise / (push.noise + n.bias), other.y);
    }
    const float mean_ = sum / weights, variance = max(squares / weights - mean_ * mean_, 0.0);
    const float varianceOfMean = variance * squaredWeights / (weights * weights);
    neighborhoods.data[node] =
        uvec4(floatBitsToUint(vec2(mean_, variance)), packUpperHalves(varianceOfMean, inverse), center.y);
}
