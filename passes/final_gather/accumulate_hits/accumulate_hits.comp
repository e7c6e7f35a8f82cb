// Irradiance of each texel of the G-buffer by its gather rays of up to `frames` frames: hits are kept, and reflect the light
// that their faces have in this frame. What a ray brought beyond the light of its face, in the frame in which it was traced,
// is averaged over frames: all of it where no face is lit.
#include "passes/cache/hit_faces/hit_face_light.glsl"
#include "passes/final_gather/accumulate_hits/kept_hit_types.h"
#include "passes/surfels/surfel_at_hit.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/view/gather_layout.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Hits { Hit data[]; } hits;
layout(scalar) readonly buffer Light { vec4 data[]; } light;  // GatherLight::light
layout(scalar) buffer Kept { KeptHit data[]; } kept;          // All rays of slot 0, of slot 1 and so on.
layout(scalar) buffer Rest { vec4 data[]; } rest;             // By ray: mean over frames, W/m².
uniform sampler2D position;
layout(rgba32f) writeonly uniform image2D result;  // W/m², number of rays.
layout(push_constant, scalar) uniform Push {
    GatherLayout layout_;
    uint firstBlock;
    uint batchBlocks;
    uint slot;  // Of this frame's hits.
    uint frames;
} push;

vec3 reflected(KeptHit hit) {
    return hit.face == NO_FACE ? vec3(0.0) : unpackUnorm4x8(hit.reflectance).rgb * hitFaceIrradiance.data[hit.face].rgb;
}

KeptHit keptHit(Hit hit, vec3 origin) {
    Surfel s;
    vec3 normal;
    float offset;
    KeptHit result_ = KeptHit(NO_FACE, 0u);
    if (!surfelAtHit(hit, origin, s, normal, offset)) return result_;
    result_.face = faceNumber(hitFace(s.position, normal));
    result_.reflectance = packUnorm4x8(vec4(s.reflectance, 0.0));
    return result_;
}

void main() {
    const GatherLayout g = push.layout_;
    const uint count = g.blockSize * g.blockSize, i = linearIndex();
    if (i >= push.batchBlocks * count) return;
    const uint blockInBatch = i / count, t = i % count, blockIndex = push.firstBlock + blockInBatch;
    const uvec2 block = uvec2(blockIndex % g.blocks.x, blockIndex / g.blocks.x);
    const uvec2 texel = texelOf(g, block, t);
    if (any(greaterThanEqual(texel, g.texels))) return;

    const uvec2 own = blockInBatch * g.raysPerBlock + texelRays(g, block, t);
    const uint allRays = push.batchBlocks * g.raysPerBlock;
    const vec3 origin = texelFetch(position, ivec2(texel), 0).xyz;
    vec3 sum = vec3(0.0);
    float rays = 0.0;
    for (uint ray = own.x; ray < own.y; ++ray) {
        if (light.data[ray].w < 0.0) continue;
        const KeptHit now = keptHit(hits.data[ray], origin);
        kept.data[push.slot * allRays + ray] = now;
        const vec3 before = push.frames == 1u ? vec3(0.0) : rest.data[ray].rgb;
        const vec3 mean = mix(before, light.data[ray].rgb - reflected(now), 1.0 / float(push.frames));
        rest.data[ray] = vec4(mean, 0.0);
        vec3 bySlots = reflected(now);
        for (uint slot = 0u; slot < push.frames; ++slot)
            if (slot != push.slot) bySlots += reflected(kept.data[slot * allRays + ray]);
        sum += bySlots / float(push.frames) + mean;
        rays += 1.0;
    }
    imageStore(result, ivec2(texel), vec4(max(sum / max(rays, 1.0), vec3(0.0)), rays * float(push.frames)));
}
