// Which gather rays go on as paths.
#ifndef VOXRAY_CHOSEN_RAYS_GLSL
#define VOXRAY_CHOSEN_RAYS_GLSL

#include "shaders/view/gather_layout.glsl"

#define CHOICE_SEQUENCE 0x3c6ef372u

// Numbers in [0, 1)² that do not depend on the ray's direction; among the rays of a block, and of neighboring ones,
// well distributed, as their samples are.
vec2 choiceOf(GatherLayout g, uint blockIndex, uint j) {
    const uvec2 block = uvec2(blockIndex % g.blocks.x, blockIndex / g.blocks.x);
    return sobol2(morton(block) * g.raysPerBlock + j, hashCombine(g.seed, CHOICE_SEQUENCE));
}

#endif
