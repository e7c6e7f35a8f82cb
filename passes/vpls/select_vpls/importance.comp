// What each virtual light of a batch brings to a texel on average, estimated by its texels, and its flux.
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/sampling.glsl"
#include "passes/vpls/vpls.glsl"
layout(local_size_x = 64) in;

readonly buffer List { uint data[]; } list;
readonly buffer Carried { float data[]; } carried;
readonly buffer Occluded { uint data[]; } occluded;
layout(scalar) writeonly buffer Importance { vec2 data[]; } importance;  // Luminance of irradiance, W/m², and of flux, W.
layout(push_constant, scalar) uniform Push {
    uint first, count;
    uint points;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    float sum = 0.0;
    for (uint p = 0u; p < push.points; ++p) {
        const uint ray = i * push.points + p;
        if (occluded.data[ray] == 0u) sum += carried.data[ray];
    }
    const float flux = luminance(vpls.data[list.data[push.first + i]].flux);
    importance.data[i] = vec2(flux * sum / float(push.points), flux);
}
