// Generates the camera rays of a batch.
#include "passes/view/gbuffer/sample_direction.glsl"
#include "passes/view/gbuffer/sampled_texel.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
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
    rays.data[i] = Ray(push.view.origin, 0.0, sampleDirection(push.view, texel, SAMPLES, push.seed), 1.0e30);
}
