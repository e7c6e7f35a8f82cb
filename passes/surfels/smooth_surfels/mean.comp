// Irradiance of each surfel as the mean of those around it. Each counts by
//
//     kernel * noise / (noise + bias²)
//
// as in filter_irradiance. noise: variance of a surfel, the mean of both, so that a pair has one weight.
// bias²: what geometry allows the two to differ by, and what the means of their surroundings do differ by beyond their noise.
#include "passes/surfels/smooth_surfels/neighbourhoods.glsl"

layout(scalar) readonly buffer ResultRef { LitSurfels result; };

float weightOf(vec3 own, vec3 other, vec2 pair) {
    const float mean_ = 0.5 * (own.x + other.x), noise = 0.5 * (own.y + other.y), apart = own.x - other.x;
    const float bias2 = pair.x * mean_ * mean_ + max(apart * apart - own.z - other.z, 0.0);
    return pair.y * (bias2 > 0.0 ? noise / max(noise + bias2, 1e-30) : 1.0);
}

void main() {
    const uint slot = linearIndex();
    if (slot >= push.count) return;
    const uvec4 words = surroundings.data[slot];
    const vec3 own = uintBitsToFloat(words.xyz);
    const uint end = begins.data[slot + 1u];
    vec3 sum = unpackRadiosity(words.w);
    float weights = 1.0;
    for (uint i = begins.data[slot]; i < end; ++i) {
        const uvec2 neighbour = pairs.data[i];
        const uvec4 other = surroundings.data[neighbour.x];
        const float weight = weightOf(own, uintBitsToFloat(other.xyz), biasAndKernel(neighbour));
        sum += weight * unpackRadiosity(other.w);
        weights += weight;
    }
    result.data[slot] = uvec3(lit.data[slot].xy, packRadiosity(sum / weights));
}
