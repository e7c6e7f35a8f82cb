// Which cones go on as paths.
#ifndef VOXRAY_CHOSEN_CONES_GLSL
#define VOXRAY_CHOSEN_CONES_GLSL

#define CHOOSES_CONES
#include "passes/cones/radiance/cone_ray_batch.glsl"
#include "shaders/scene/sampling.glsl"

#define CHOICE_SEED 0x3c6ef372u

// With the probability of the batch, whatever the cone's direction: systematic sampling of a texel's cones, whose paths
// then are the same number within one.
bool isChosen(uint i) {
    const uint texel = push.firstTexel + i / push.conesPerTexel;
    const float start = toUnit(hashCombine(push.seed ^ CHOICE_SEED, texel));
    return fract(start + float(i % push.conesPerTexel) * push.probability) < push.probability;
}

#endif
