// Irradiance of each G-buffer texel: the mean over its resampled rays.
#include "shaders/compute/linear_index.glsl"
#include "shaders/view/gather_layout.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Resampled { vec4 data[]; } resampled;
layout(scalar) readonly buffer Occluded { uint data[]; } occluded;
layout(scalar) readonly buffer EffectiveRays { float data[]; } effectiveRays;
layout(rgba32f) writeonly uniform image2D result;  // Irradiance, W/m²; number of rays.
layout(push_constant, scalar) uniform Push {
    GatherLayout layout_;
    uint firstBlock;
    uint batchBlocks;
} push;

void main() {
    const GatherLayout g = push.layout_;
    const uint count = g.blockSize * g.blockSize, i = linearIndex();
    if (i >= push.batchBlocks * count) return;
    const uint blockInBatch = i / count, t = i % count, blockIndex = push.firstBlock + blockInBatch;
    const uvec2 block = uvec2(blockIndex % g.blocks.x, blockIndex / g.blocks.x);
    const uvec2 texel = texelOf(g, block, t);
    if (any(greaterThanEqual(texel, g.texels))) return;
    const uvec2 own = texelRays(g, block, t);
    vec3 sum = vec3(0.0);
    float rays = 0.0;
    for (uint j = own.x; j < own.y; ++j) {
        const uint local = blockInBatch * g.raysPerBlock + j;
        const vec4 value = resampled.data[local];
        if (value.w < 0.0) continue;
        if (occluded.data[local] == 0u) sum += value.rgb;
        rays += 1.0;
    }
    imageStore(result, ivec2(texel), vec4(sum / max(rays, 1.0), rays * effectiveRays.data[blockInBatch]));
}
