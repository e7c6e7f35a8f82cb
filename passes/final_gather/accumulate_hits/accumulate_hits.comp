// Irradiance of each texel of the G-buffer by its gather rays of up to `frames` frames: hits are kept, and reflect the light
// that their faces have in this frame. What a ray brought beyond the light of its face, in the frame in which it was traced,
// is kept with its hit: all of it where no face was lit.
#include "passes/cache/hit_faces/hit_face_light.glsl"
#include "passes/final_gather/accumulate_hits/kept_hit_types.h"
#include "passes/surfels/surfel_at_hit.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/view/gather_layout.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Hits { Hit data[]; } hits;
layout(scalar) readonly buffer Light { vec4 data[]; } light;  // GatherLight::light
layout(scalar) buffer Kept { KeptHit data[]; } kept;          // All rays of slot 0, of slot 1 and so on.
uniform sampler2D position;
layout(rgba32f) writeonly uniform image2D result;  // W/m², number of rays.
layout(push_constant, scalar) uniform Push {
    GatherLayout layout_;
    uint firstBlock;
    uint batchBlocks;
    uint slot;  // Of this frame's hits.
    uint frames;
} push;

vec3 reflected(uint face, uint reflectance) {
    return face == NO_FACE ? vec3(0.0) : unpackUnorm4x8(reflectance).rgb * hitFaceIrradiance.data[face].rgb;
}

// `brought`: by the hit's ray, W/m².
KeptHit keptHit(Hit hit, vec3 origin, vec3 brought) {
    Surfel s;
    vec3 normal;
    float offset;
    if (!surfelAtHit(hit, origin, s, normal, offset)) return KeptHit(NO_FACE, 0u, brought);
    const uint face = faceNumber(hitFace(s.position, normal)), reflectance = packUnorm4x8(vec4(s.reflectance, 0.0));
    // From a face without light the ray went on as a path, and brought what the face will have
    if (face == NO_FACE || hitFaceIrradiance.data[face].w == 0.0) return KeptHit(NO_FACE, 0u, brought);
    return KeptHit(face, reflectance, brought - reflected(face, reflectance));
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
        kept.data[push.slot * allRays + ray] = keptHit(hits.data[ray], origin, light.data[ray].rgb);
        for (uint slot = 0u; slot < push.frames; ++slot) {
            const KeptHit hit = kept.data[slot * allRays + ray];
            sum += hit.rest + reflected(hit.face, hit.reflectance);
        }
        rays += 1.0;
    }
    imageStore(result, ivec2(texel), vec4(max(sum / max(rays * float(push.frames), 1.0), vec3(0.0)), rays * float(push.frames)));
}
