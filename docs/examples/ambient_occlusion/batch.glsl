// A batch of ambient rays: ordered by pixel, and in a pixel by texel.
#include "shaders/compute/linear_index.glsl"
#include "shaders/trace/ray_types.h"

layout(push_constant, scalar) uniform Push {
    uint width;
    uint firstPixel;
    uint pixels;
    uint samples;  // Texels of the g-buffer along each side of a pixel.
    uint raysPerTexel;
    float radius;
    uint seed;
    vec3 ambient;
} push;

// Coordinates of a texel in the g-buffer, by its index in the batch.
ivec2 texelOf(uint number) {
    const uint perPixel = push.samples * push.samples, within = number % perPixel;
    const uint pixel = push.firstPixel + number / perPixel;
    return ivec2(uvec2(pixel % push.width, pixel / push.width) * push.samples +
                 uvec2(within % push.samples, within / push.samples));
}
