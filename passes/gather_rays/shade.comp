#version 460
#extension GL_GOOGLE_include_directive : require
// Irradiance of each G-buffer texel: the mean over its rays of pi times the radiance that their hits reflect. A ray that
// misses brings none: the environment is direct light.
#include "shaders/face_irradiance.glsl"
#include "shaders/gather_layout.glsl"
#include "shaders/linear_index.glsl"
#include "shaders/scene.glsl"
#include "shaders/shared/ray_types.h"
layout(local_size_x = 64) in;

layout(set = 0, binding = 16, scalar) readonly buffer Hits { Hit data[]; } hits;
layout(set = 0, binding = 17) uniform sampler2D position;
layout(set = 0, binding = 18, rgba32f) writeonly uniform image2D gathered;  // Mean irradiance, number of rays.
// Over the texel's rays: sums of 1 / distance, of luminance and of its square; their number.
layout(set = 0, binding = 19, rgba32f) writeonly uniform image2D moments;
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    GatherLayout layout_;
    uint firstBlock;
    uint batchBlocks;
} push;

// Radiance times pi that the hit surface reflects towards `from`.
vec3 reflected(Hit hit, vec3 from) {
    const SurfacePoint s = surfacePoint(hit.triangle, vec2(hit.u, hit.v));
    if (dot(s.geometricNormal, s.geometricNormal) == 0.0) return vec3(0.0);
    const vec3 normal = dot(s.geometricNormal, from - s.position) >= 0.0 ? s.geometricNormal : -s.geometricNormal;
    bool known;
    const vec3 irradiance = irradianceAt(push.grid, s.position, normal, known);
    return diffuseAlbedo(sceneMaterials.data[s.material], s, 0.0) * irradiance;
}

void main() {
    const GatherLayout g = push.layout_;
    const uint count = g.blockSize * g.blockSize;
    const uint i = linearIndex();
    if (i >= push.batchBlocks * count) return;
    const uint blockInBatch = i / count, t = i % count, blockIndex = push.firstBlock + blockInBatch;
    const uvec2 block = uvec2(blockIndex % g.blocks.x, blockIndex / g.blocks.x);
    const ivec2 texel = ivec2(texelOf(g, block, t));
    if (any(greaterThanEqual(texel, ivec2(g.texels)))) return;
    const vec4 p = texelFetch(position, texel, 0);

    // Rays of this texel: a run of the block's, or one of those near its place where texels outnumber rays.
    const uint shift = blockShift(g, block);
    const bool fewer = g.raysPerBlock < count;
    const uint guess = t * g.raysPerBlock / count;
    const uint first = fewer ? max(guess, 1u) - 1u : firstRay(g, t);
    const uint last = min(fewer ? guess + 2u : firstRay(g, t + 1u), g.raysPerBlock);
    vec3 sum = vec3(0.0);
    vec3 sums = vec3(0.0);
    float rays = 0.0;
    for (uint j = first; j < last && p.w > 0.0; ++j) {
        if (fewer && rayTexel(g, shift, j) != t) continue;
        rays += 1.0;
        const Hit hit = hits.data[blockInBatch * g.raysPerBlock + j];
        if (hit.triangle == NO_HIT) continue;
        const vec3 light = reflected(hit, p.xyz);
        const float l = luminance(light);
        sums += vec3(1.0 / max(hit.t, 1e-6), l, l * l);
        sum += light;
    }
    imageStore(gathered, texel, vec4(rays > 0.0 ? sum / rays : vec3(0.0), rays));
    imageStore(moments, texel, vec4(sums, rays));
}
