// Importance of each virtual light of a batch: its mean irradiance at random texels, and its flux.
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/sampling.glsl"
#include "passes/vpls/vpls.glsl"
layout(local_size_x = 64) in;

readonly buffer ActiveVpls { uint data[]; } activeVpls;
readonly buffer GeometryTerms { float data[]; } geometryTerms;
readonly buffer Occluded { uint data[]; } occluded;
// Luminance of irradiance, W/m², and of flux, W.
layout(scalar) writeonly buffer Importance { vec2 data[]; } importance;
layout(push_constant, scalar) uniform Push {
    uint first, count;
    uint texelsPerVpl;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    float sum = 0.0;
    for (uint texel = 0u; texel < push.texelsPerVpl; ++texel) {
        const uint ray = i * push.texelsPerVpl + texel;
        if (occluded.data[ray] == 0u) sum += geometryTerms.data[ray];
    }
    const float flux = luminance(vpls.data[activeVpls.data[push.first + i]].flux);
    importance.data[i] = vec2(flux * sum / float(push.texelsPerVpl), flux);
}
