// The variance of a level's input over that of as many independent rays, from sums over tiles (noise.comp). Rays that
// are stratified over neighboring pixels have less noise the more of them are averaged, so the ratio does not grow from
// level to level: where the measured one does, differences are of light. At most 1.
#include "passes/view/filter_irradiance/noise_ratio.glsl"
layout(local_size_x = 256) in;

layout(scalar) readonly buffer Noise { NoiseSums data[]; } noise;
layout(scalar) buffer NoiseRatio { float data[]; } noiseRatio;  // By level.
layout(push_constant) uniform Push {
    uint tiles;
    uint level;
} push;

// Keeps weights defined where neighbors are equal.
#define LEAST_RATIO 0.01

shared NoiseSums sums[gl_WorkGroupSize.x];

void main() {
    const uint thread = gl_LocalInvocationIndex;
    NoiseSums sum = NoiseSums(0.0, 0.0);
    for (uint i = thread; i < push.tiles; i += gl_WorkGroupSize.x) sum = added(sum, noise.data[i]);
    sums[thread] = sum;
    for (uint half_ = gl_WorkGroupSize.x / 2u; half_ > 0u; half_ /= 2u) {
        barrier();
        if (thread < half_) sums[thread] = added(sums[thread], sums[thread + half_]);
    }
    if (thread > 0u) return;
    const float previous = push.level == 0u ? 1.0 : noiseRatio.data[push.level - 1u];
    const float measured = sums[0].independent > 0.0 ? sums[0].measured / sums[0].independent : previous;
    noiseRatio.data[push.level] = clamp(measured, LEAST_RATIO, previous);
}
