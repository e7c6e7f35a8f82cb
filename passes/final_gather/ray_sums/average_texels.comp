// Irradiance of each G-buffer texel: the mean over its gather rays.
#include "shaders/view/gather_layout.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

// Per ray: radiance times pi; distance of the hit, m, 1e30 for a miss, -1 for a ray that starts from no surface.
layout(scalar) readonly buffer Light { vec4 data[]; } light;
layout(rgba32f) writeonly uniform image2D gathered;  // Irradiance, W/m²; number of rays.
layout(push_constant, scalar) uniform Push {
    GatherLayout layout_;
    uint firstBlock;
    uint batchBlocks;
} push;

void main() {
    const GatherLayout g = push.layout_;
    const uint count = g.blockSize * g.blockSize;
    const uint i = linearIndex();
    if (i >= push.batchBlocks * count) return;
    const uint blockInBatch = i / count, t = i % count, blockIndex = push.firstBlock + blockInBatch;
    const uvec2 block = uvec2(blockIndex % g.blocks.x, blockIndex / g.blocks.x);
    const uvec2 texel = texelOf(g, block, t);
    if (any(greaterThanEqual(texel, g.texels))) return;

    const uvec2 own = texelRays(g, block, t);
    vec3 sum = vec3(0.0);
    float rays = 0.0;
    for (uint j = own.x; j < own.y; ++j) {
        const vec4 light_ = light.data[blockInBatch * g.raysPerBlock + j];
        if (light_.w < 0.0) continue;
        sum += light_.rgb;
        rays += 1.0;
    }
    imageStore(gathered, ivec2(texel), vec4(sum / max(rays, 1.0), rays));
}
