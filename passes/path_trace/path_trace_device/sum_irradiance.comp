// Irradiance of indirect light at the G-buffer's texels: the mean over the paths of a batch that start in each.
#include "passes/path_trace/path_streams/path_batch.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Sums { PathSums data[]; } sums;
layout(rgba32f) uniform image2D irradiance;  // Of the last batch of a pixel: the mean; before: the sum. a: paths.
layout(push_constant, scalar) uniform Push {
    PathBatch batch;
    uint texels;  // Along a pixel's edge.
    uint isFirst;  // 1: of the image's batches of this pixel.
    uint isLast;
} push;

void main() {
    const uint i = linearIndex(), perPixel = push.texels * push.texels;
    if (i >= push.batch.pixels * perPixel) return;
    const uint index = i / perPixel;
    const uvec2 pixel = pixelOf(push.batch, index);
    if (!isInside(push.batch, pixel)) return;
    const uvec2 within = uvec2(i % perPixel % push.texels, i % perPixel / push.texels);
    const ivec2 texel = ivec2(pixel * push.texels + within);
    vec4 sum = push.isFirst != 0u ? vec4(0.0) : imageLoad(irradiance, texel);
    for (uint s = 0u; s < push.batch.samples; ++s) {
        const PathSums path = sums.data[index * push.batch.samples + s];
        const vec2 position = positionInPixel(samplerOf(push.batch, pixel, s)) * float(push.texels);
        if (path.hasIrradiance != 0u && min(uvec2(position), uvec2(push.texels - 1u)) == within)
            sum += vec4(path.irradiance, 1.0);
    }
    if (push.isLast != 0u) sum.rgb /= max(sum.a, 1.0);
    imageStore(irradiance, texel, sum);
}
