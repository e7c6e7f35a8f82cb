// Which gather rays go on as paths.
#ifndef VOXRAY_CHOSEN_RAYS_GLSL
#define VOXRAY_CHOSEN_RAYS_GLSL

#include "passes/final_gather/residual_rays/residual_types.h"
#include "shaders/view/gather_layout.glsl"

#ifdef TILES
layout(scalar) readonly buffer Tiles { ResidualTile data[]; } tiles;
#endif

#define CHOICE_SEQUENCE 0x3c6ef372u

// Numbers in [0, 1)² that do not depend on the ray's direction; among the rays of a block, and of neighboring ones,
// well distributed, as their samples are.
vec2 choiceOf(GatherLayout g, uint blockIndex, uint j) {
    const uvec2 block = uvec2(blockIndex % g.blocks.x, blockIndex / g.blocks.x);
    return sobol2(morton(block) * g.raysPerBlock + j, hashCombine(g.seed, CHOICE_SEQUENCE));
}

// The probability with which ray j of a block, given its role, goes on: pilots always do.
float probabilityOf(GatherLayout g, ResidualChoice c, uint blockIndex, bool isPilot) {
    if (isPilot) return 1.0;
#ifdef TILES
    const uvec2 block = uvec2(blockIndex % g.blocks.x, blockIndex / g.blocks.x), tile = block / c.tileBlocks;
    return tiles.data[tile.y * c.tiles.x + tile.x].probability;
#else
    return c.probability;
#endif
}

// Whether ray j of a block goes on in this round; `probability`: with which of its role it does.
bool isChosen(GatherLayout g, ResidualChoice c, uint blockIndex, uint j, out float probability) {
    const vec2 choice = choiceOf(g, blockIndex, j);
    const bool isPilot = choice.y < c.pilots;
    probability = probabilityOf(g, c, blockIndex, isPilot);
    return isPilot == (c.round_ == ROUND_PILOTS) && choice.x < probability;
}

#endif
