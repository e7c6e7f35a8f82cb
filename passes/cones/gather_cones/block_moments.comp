// Moments of each block: the sums over its traced texels.
#include "passes/cones/radiance/texel_stride.glsl"
#include "shaders/filter/ray_moments.h"
layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar) readonly buffer TexelMoments { RayMoments data[]; } texelMoments;  // By traced texel of the image.
layout(scalar) writeonly buffer Moments { RayMoments data[]; } moments;
layout(push_constant) uniform Push {
    uvec2 texels;  // Of the G-buffer.
    uvec2 blocks;
    int blockSize;  // Texels along an edge.
    int stride;
    int tracedColumns;
} push;

void main() {
    const uvec2 block = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(block, push.blocks))) return;
    const ivec2 first = ivec2(block) * push.blockSize, end = min(first + push.blockSize, ivec2(push.texels));
    RayMoments sum = RayMoments(0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    for (int y = first.y; y < end.y; ++y)
        for (int x = first.x; x < end.x; ++x) {
            const int column = x - rowShift(y, push.stride);
            if (column < 0 || column % push.stride != 0) continue;
            const RayMoments texel = texelMoments.data[y * push.tracedColumns + column / push.stride];
            sum.rays += texel.rays;
            sum.luminance += texel.luminance;
            sum.squared += texel.squared;
        }
    moments.data[block.y * push.blocks.x + block.x] = sum;
}
