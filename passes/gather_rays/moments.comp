#version 460
#extension GL_GOOGLE_include_directive : require
// Sums over the rays of each block that tell how noisy they are and how fast irradiance may change there.
#include "passes/gather_rays/arrived.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/sampling.glsl"
#include "shaders/filter/gather_filter.h"
layout(local_size_x = 64) in;

layout(scalar) writeonly buffer Moments { GatherMoments data[]; } moments;
layout(push_constant) uniform Push {
    uint firstBlock;
    uint batchBlocks;
    uint raysPerBlock;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.batchBlocks) return;
    GatherMoments sum = GatherMoments(0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    for (uint j = 0u; j < push.raysPerBlock; ++j) {
        const vec4 light_ = arrived(i * push.raysPerBlock + j);
        if (light_.w < 0.0) continue;
        const float l = luminance(light_.rgb), nearness = 1.0 / max(light_.w, 1e-6);
        sum.rays += 1.0;
        sum.luminance += l;
        sum.squared += l * l;
        sum.nearness += nearness;
        sum.nearLuminance += l * nearness;
        sum.nearSquared += l * l * nearness;
    }
    moments.data[push.firstBlock + i] = sum;
}
