// What the surface at each gather ray's hit reflects of the light that is stored there: radiance times pi. A ray that misses
// brings none: the environment is direct light. With SHADOW_RAYS indirect light alone is stored, and direct light is measured at
// each hit.
#include "passes/final_gather/gather_rays/hit.glsl"
#include "shaders/view/gather_layout.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Hits { Hit data[]; } hits;
uniform sampler2D position;
layout(push_constant, scalar) uniform Push {
    GatherLayout layout_;
    uint firstBlock;
    uint rays;
    float nearField;  // Cells.
} push;

#define MISSED 1.0e30

void main() {
    const GatherLayout g = push.layout_;
    const uint i = linearIndex();
    if (i >= push.rays) return;
    const uint blockIndex = push.firstBlock + i / g.raysPerBlock;
    const uvec2 block = uvec2(blockIndex % g.blocks.x, blockIndex / g.blocks.x);
    const uvec2 texel = texelOf(g, block, rayTexel(g, block, i % g.raysPerBlock));
    const vec4 from = all(lessThan(texel, g.texels)) ? texelFetch(position, ivec2(texel), 0) : vec4(0.0);

    // Distance of the hit in m, infinite for a miss, negative for a ray that starts from no surface.
    const Hit hit = hits.data[i];
    light.data[i] = vec4(vec3(0.0), hit.triangle != NO_HIT ? hit.t : from.w > 0.0 ? MISSED : -1.0);
    const uint id = push.firstBlock * g.raysPerBlock + i;
    if (hit.triangle != NO_HIT) shadeHit(i, hit, from.xyz, vec3(1.0), id, push.nearField);
}
