// Generates the camera rays of a batch.
#include "passes/view/gbuffer/sample_direction.glsl"
#include "passes/view/gbuffer/sampled_texel.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

layout(scalar) writeonly buffer Rays { u64vec4 data[]; } rays;  // Ray, in words of 64 bits.
layout(push_constant, scalar) uniform Push {
    CameraView view;
    uint seed;  // Of the frame.
    uint firstRay;
    uint batchRays;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.batchRays) return;
    const uvec2 texel = uvec2(sampledTexel(push.firstRay + i, push.view.width));
    const uvec4 from = floatBitsToUint(vec4(push.view.origin, 0.0));
    const uvec4 along = floatBitsToUint(vec4(sampleDirection(push.view, texel, SAMPLES, push.seed), 1.0e30));
    rays.data[i] = u64vec4(packUint2x32(from.xy), packUint2x32(from.zw), packUint2x32(along.xy), packUint2x32(along.zw));
}
