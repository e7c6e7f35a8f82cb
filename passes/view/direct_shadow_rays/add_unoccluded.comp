// Adds the radiance of unoccluded shadow rays, averaged over each pixel of a batch.
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer RayRadiance { vec4 data[]; } rayRadiance;
layout(scalar) readonly buffer Occluded { uint data[]; } occluded;
layout(rgba32f) uniform image2D direct;
layout(push_constant, scalar) uniform Push {
    uint width;  // Pixels of a row.
    uint firstPixel;
    uint batchPixels;
    uint raysPerPixel;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.batchPixels) return;
    vec3 sum = vec3(0.0);
    for (uint k = 0u; k < push.raysPerPixel; ++k) {
        const uint ray = i * push.raysPerPixel + k;
        if (occluded.data[ray] == 0u) sum += rayRadiance.data[ray].rgb;
    }
    const uint index = push.firstPixel + i;
    const ivec2 pixel = ivec2(index % push.width, index / push.width);
    imageStore(direct, pixel, imageLoad(direct, pixel) + vec4(sum / float(push.raysPerPixel), 0.0));
}
