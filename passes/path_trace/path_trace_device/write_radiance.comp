// Writes an image of the pixels' sums.
#include "passes/path_trace/path_streams/path_types.h"
layout(local_size_x = 8, local_size_y = 8) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Pixels { PixelSums data[]; };
layout(rgba32f) uniform writeonly image2D target;
layout(push_constant, scalar) uniform Push {
    uint64_t pixelSums;
    vec2 weights;    // Of the halves: one over the number of samples, or 0.
    uint isIndirect;
} push;

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(target);
    if (any(greaterThanEqual(pixel, size))) return;
    const PixelSums s = Pixels(push.pixelSums).data[pixel.y * size.x + pixel.x];
    const vec3 mean = push.isIndirect != 0u ? push.weights.x * s.indirect[0] + push.weights.y * s.indirect[1]
                                            : push.weights.x * s.total[0] + push.weights.y * s.total[1];
    imageStore(target, pixel, vec4(mean, 1.0));
}
