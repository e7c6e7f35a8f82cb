// Sums the unoccluded contributions of a batch's virtual lights at each receiver.
#include "passes/vpls/gather_vpls/batch.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/sampling.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Contributions { vec4 data[]; } contributions;  // Irradiance, W/m²; 1 / distance, 1/m.
layout(scalar) readonly buffer Occluded { uint data[]; } occluded;
#ifdef SURFELS
layout(scalar) buffer Irradiance { vec4 data[]; } irradiance;  // W/m²
#else
layout(rgba32f) uniform image2D irradiance;  // W/m²; number of virtual lights.
layout(rgba32f) uniform image2D texelMoments;        // Sums of sampleMoments() over virtual lights.
#include "passes/vpls/gather_vpls/sample_moments.glsl"
#endif
layout(push_constant, scalar) uniform Push { VplBatch batch; } push;

void main() {
    const uint i = linearIndex();
    if (i >= push.batch.receiverCount) return;
#ifdef SURFELS
    const uint target = batchSurfel(push.batch, i);
#else
    const ivec2 target = batchTexel(push.batch, i);
#endif
    if (isOutside(push.batch, target)) return;
    // A subset has 1 / block² of the lights: its sum times block² estimates the sum over all
    const float subsets = float(push.batch.block * push.batch.block);
    vec3 irradianceSum = vec3(0.0);
    vec4 momentSum = vec4(0.0);
    for (uint vpl = 0u; vpl < push.batch.vplCount; ++vpl) {
        const uint ray = vpl * push.batch.receiverCount + i;
        if (occluded.data[ray] != 0u) continue;
        const vec4 contribution = contributions.data[ray];
        irradianceSum += subsets * contribution.rgb;
#ifndef SURFELS
        momentSum += sampleMoments(subsets * contribution.rgb, contribution.w);
#endif
    }
#ifdef SURFELS
    irradiance.data[target].rgb += irradianceSum;
#else
    imageStore(irradiance, target, imageLoad(irradiance, target) + vec4(irradianceSum, float(push.batch.vplCount)));
    imageStore(texelMoments, target, imageLoad(texelMoments, target) + momentSum);
#endif
}
