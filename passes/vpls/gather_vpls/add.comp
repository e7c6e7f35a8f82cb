// Adds up what the virtual lights of a batch send to each of its receivers.
#include "passes/vpls/gather_vpls/batch.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/sampling.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Carried { vec4 data[]; } carried;
layout(scalar) readonly buffer Occluded { uint data[]; } occluded;
#ifdef SURFELS
layout(scalar) buffer Irradiance { vec4 data[]; } irradiance;  // W/m²
#else
layout(rgba32f) uniform image2D irradiance;  // W/m²; number of virtual lights.
layout(rgba32f) uniform image2D sums;        // Over virtual lights, of what each brings: sums.glsl
#include "passes/vpls/gather_vpls/sums.glsl"
#endif
layout(push_constant, scalar) uniform Push { VplBatch batch; } push;

void main() {
    const uint i = linearIndex();
    if (i >= push.batch.count) return;
#ifdef SURFELS
    const uint receiver = batchSurfel(push.batch, i);
#else
    const ivec2 receiver = batchTexel(push.batch, i);
#endif
    if (isOutside(push.batch, receiver)) return;
    // Each virtual light is in one of block² subsets: on average over these, so many times a subset's light is that of all
    const float subsets = float(push.batch.block * push.batch.block);
    vec3 sum = vec3(0.0);
    vec4 moments = vec4(0.0);
    for (uint v = 0u; v < push.batch.vplCount; ++v) {
        const uint ray = v * push.batch.count + i;
        if (occluded.data[ray] != 0u) continue;
        const vec4 light = carried.data[ray];
        sum += subsets * light.rgb;
#ifndef SURFELS
        moments += sumsOf(subsets * light.rgb, light.w);
#endif
    }
#ifdef SURFELS
    irradiance.data[receiver].rgb += sum;
#else
    imageStore(irradiance, receiver, imageLoad(irradiance, receiver) + vec4(sum, float(push.batch.vplCount)));
    imageStore(sums, receiver, imageLoad(sums, receiver) + moments);
#endif
}
