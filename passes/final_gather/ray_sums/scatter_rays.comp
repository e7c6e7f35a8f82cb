// Irradiance of the G-buffer texels that gather rays start from, where a block has fewer rays than texels, so that none
// has two. The others are cleared before.
#include "shaders/view/gather_layout.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Light { vec4 data[]; } light;  // average_texels.comp
layout(rgba32f) writeonly uniform image2D gathered;           // Irradiance, W/m²; number of rays.
layout(push_constant, scalar) uniform Push {
    GatherLayout layout_;
    uint firstBlock;
    uint batchBlocks;
} push;

void main() {
    const GatherLayout g = push.layout_;
    const uint i = linearIndex();
    if (i >= push.batchBlocks * g.raysPerBlock) return;
    const uint blockIndex = push.firstBlock + i / g.raysPerBlock;
    const uvec2 block = uvec2(blockIndex % g.blocks.x, blockIndex / g.blocks.x);
    const uvec2 texel = texelOf(g, block, rayTexel(g, block, i % g.raysPerBlock));
    const vec4 light_ = light.data[i];
    if (light_.w >= 0.0 && all(lessThan(texel, g.texels))) imageStore(gathered, ivec2(texel), vec4(light_.rgb, 1.0));
}
