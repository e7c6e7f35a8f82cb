// Each surfel's irradiance becomes the weighted mean over itself and its neighbors, with the weights of
// filter_irradiance:
//
//     kernel * noise / (noise + bias²)
//
// noise: the variance of a surfel's irradiance, the mean of both, so that a pair has one weight. bias²: by how much the
// two may differ for their geometry, plus the squared difference of their neighborhoods' means beyond its variance.
#include "passes/surfels/smooth_surfels/neighborhoods.glsl"

layout(scalar) readonly buffer ResultRef { LitSurfels result; };

// `a`, `b`: the moments of Neighborhoods. `pair`: biasAndKernel().
float weightOf(vec3 a, vec3 b, vec2 pair) {
    const float mean_ = 0.5 * (a.x + b.x), noise = 0.5 * (a.y + b.y), difference = a.x - b.x;
    const float bias2 = pair.x * mean_ * mean_ + max(difference * difference - a.z - b.z, 0.0);
    return pair.y * (bias2 > 0.0 ? noise / max(noise + bias2, 1e-30) : 1.0);
}

void main() {
    const uint surfel = linearIndex();
    if (surfel >= push.count) return;
    const uvec4 center = neighborhoods.data[surfel];
    const uint end = begins.data[surfel + 1u];
    vec3 sum = unpackRadiosity(center.w);
    float weights = 1.0;
    for (uint i = begins.data[surfel]; i < end; ++i) {
        const uvec2 pair = pairs.data[i];
        const uvec4 neighbor = neighborhoods.data[pair.x];
        const float weight = weightOf(uintBitsToFloat(center.xyz), uintBitsToFloat(neighbor.xyz), biasAndKernel(pair));
        sum += weight * unpackRadiosity(neighbor.w);
        weights += weight;
    }
    result.data[surfel] = uvec3(lit.data[surfel].xy, packRadiosity(sum / weights));
}
