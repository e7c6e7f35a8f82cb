// Shades the hit of each gather ray with stored light: radiance times pi. Rays that miss get none, as the environment
// is direct light. With SHADOW_RAYS only indirect light is stored, and shadow rays measure direct light at each hit.
#include "passes/final_gather/stored_light/shade_hit.glsl"
#include "shaders/view/gather_layout.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Hits { Hit data[]; } hits;
#ifdef NEAR_DISTANCES
layout(scalar) writeonly buffer NearDistances { float data[]; } nearDistances;
#endif
uniform sampler2D position;
layout(push_constant, scalar) uniform Push {
    GatherLayout layout_;
    uint firstBlock;
    uint rays;
    float nearField;  // Cells.
} push;

#define MISS_DISTANCE 1.0e30

void main() {
    const GatherLayout g = push.layout_;
    const uint i = linearIndex();
    if (i >= push.rays) return;
    const uint blockIndex = push.firstBlock + i / g.raysPerBlock;
    const uvec2 block = uvec2(blockIndex % g.blocks.x, blockIndex / g.blocks.x);
    const uvec2 texel = texelOf(g, block, rayTexel(g, block, i % g.raysPerBlock));
    const vec4 from = all(lessThan(texel, g.texels)) ? texelFetch(position, ivec2(texel), 0) : vec4(0.0);

    // w: distance of the hit, m, or 1e30 for a miss; -1 for a ray that starts from no surface
    const Hit hit = hits.data[i];
    light.data[i] = vec4(vec3(0.0), hit.triangle != NO_HIT ? hit.t : from.w > 0.0 ? MISS_DISTANCE : -1.0);
    const uint id = push.firstBlock * g.raysPerBlock + i;
    float nearDistance = 0.0;
    if (hit.triangle != NO_HIT) nearDistance = shadeHit(i, hit, from.xyz, vec3(1.0), id, push.nearField);
#ifdef NEAR_DISTANCES
    nearDistances.data[i] = nearDistance;
#endif
}
