#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Adds up what the virtual lights of a batch send to each of its texels.
#include "passes/gather_vpls/batch.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

uniform sampler2D position;
layout(scalar) readonly buffer Carried { vec4 data[]; } carried;
layout(scalar) readonly buffer Occluded { uint data[]; } occluded;
layout(rgba32f) uniform image2D irradiance;
layout(push_constant, scalar) uniform Push { Batch batch; } push;

void main() {
    const uint i = linearIndex();
    if (i >= push.batch.texelCount) return;
    const ivec2 texel = batchTexel(push.batch, i);
    if (isOutside(push.batch, texel) || texelFetch(position, texel, 0).w == 0.0) return;
    vec3 sum = vec3(0.0);
    for (uint v = 0u; v < push.batch.vplCount; ++v) {
        const uint ray = v * push.batch.texelCount + i;
        if (occluded.data[ray] == 0u) sum += carried.data[ray].rgb;
    }
    // Each virtual light is in one of block² subsets: on average over these, so many times a subset's light is that of all
    sum *= float(push.batch.block * push.batch.block);
    // A subset without virtual lights tells as much as one light
    imageStore(irradiance, texel, imageLoad(irradiance, texel) + vec4(sum, float(max(push.batch.vplCount, 1u))));
}
