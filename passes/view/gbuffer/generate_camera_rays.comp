// Generates the camera rays of a batch of texels.
#include "passes/view/gbuffer/sample_direction.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
layout(push_constant, scalar) uniform Push {
    CameraView view;
    uint samples;
    uint seed;  // Of the frame.
    uint firstTexel;
    uint batchRays;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.batchRays) return;
    const uint texel = push.firstTexel + i;
    const uvec2 position = uvec2(texel % push.view.width, texel / push.view.width);
    rays.data[i] = Ray(push.view.origin, 0.0, sampleDirection(push.view, position, push.samples, push.seed), 1.0e30);
}
