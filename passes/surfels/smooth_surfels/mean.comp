// Each surfel's irradiance becomes the weighted mean over itself and its neighbors, with the weights of
// filter_irradiance:
//
//     kernel * noise / (noise + bias²)
//
// noise: the variance of a surfel's irradiance, the mean of both, so that a pair has one weight. bias²: by how much the
// two may differ for their geometry, plus the squared difference of their neighborhoods' means beyond its variance.
#include "passes/surfels/smooth_surfels/neighborhoods.glsl"

// `a`, `b`: Neighborhoods.
float weightOf(uvec4 a, uvec4 b, uvec2 pair) {
    const Neighbor n = neighborOf(pair, lowerHalf(a.z), lowerHalf(b.z));
    const vec2 ofA = uintBitsToFloat(a.xy), ofB = uintBitsToFloat(b.xy);
    const float mean_ = 0.5 * (ofA.x + ofB.x), noise = 0.5 * (ofA.y + ofB.y), difference = ofA.x - ofB.x;
    const float bias2 =
        n.bias * mean_ * mean_ + max(difference * difference - upperHalf(a.z) - upperHalf(b.z), 0.0);
    return n.kernel * (bias2 > 0.0 ? noise / max(noise + bias2, 1e-30) : 1.0);
}

void main() {
    const uint node = linearIndex();
    if (node >= push.count) return;
    const uvec4 center = neighborhoods.data[node];
    const uvec2 range = ranges.data[node];
    vec3 sum = unpackRadiosity(center.w);
    float weights = 1.0;
    for (uint i = range.x; i < range.y; ++i) {
        const uvec2 pair = pairs.data[i];
        const uvec4 neighbor = neighborhoods.data[pair.x];
        const float weight = weightOf(center, neighbor, pair);
        sum += weight * unpackRadiosity(neighbor.w);
        weights += weight;
    }
    nodes.data[node].y = packRadiosity(sum / weights);
}
