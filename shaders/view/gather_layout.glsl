// Which texel a gather ray starts from, and which sample of the frame's one low-discrepancy sequence it takes.
//
// Blocks take consecutive runs of the sequence in Morton order (Ahmed and Wonka 2020), and a block's texels consecutive
// parts of its run. Aligned runs of an Owen-scrambled Sobol sequence are stratified, so the rays of a texel, of a block and
// of any larger square of blocks are all well spread, and neighbours complement each other.
#ifndef VOXRAY_GATHER_LAYOUT_GLSL
#define VOXRAY_GATHER_LAYOUT_GLSL

#include "shaders/scene/sampling.glsl"
#include "shaders/view/gather_types.h"

uint spreadBits(uint x) {
    x &= 0xffffu;
    x = (x | (x << 8)) & 0x00ff00ffu;
    x = (x | (x << 4)) & 0x0f0f0f0fu;
    x = (x | (x << 2)) & 0x33333333u;
    return (x | (x << 1)) & 0x55555555u;
}

uint gatherBits(uint x) {
    x &= 0x55555555u;
    x = (x | (x >> 1)) & 0x33333333u;
    x = (x | (x >> 2)) & 0x0f0f0f0fu;
    x = (x | (x >> 4)) & 0x00ff00ffu;
    return (x | (x >> 8)) & 0xffffu;
}

uint morton(uvec2 p) { return spreadBits(p.x) | (spreadBits(p.y) << 1); }
uvec2 mortonInverse(uint code) { return uvec2(gatherBits(code), gatherBits(code >> 1)); }

// Texel in the block, in Morton order, that ray j starts from. Where a block has fewer rays than texels, a ray stands for a run of
// them and starts from a random one: were the choice alike in all blocks, the filter, whose steps are powers of two, would show
// stripes.
uint rayTexel(GatherLayout g, uvec2 block, uint j) {
    const uint count = g.blockSize * g.blockSize;
    const uint first = j * count / g.raysPerBlock;
    if (g.raysPerBlock >= count) return first;
    const uint run = (j + 1u) * count / g.raysPerBlock - first;
    return first + hashCombine(g.seed ^ 0x5bd1e995u, morton(block) * g.raysPerBlock + j) % run;
}

// First ray of a block at or after which rays start from texel t, where rays are no fewer than texels: ceil(t * rays / count).
uint firstRay(GatherLayout g, uint t) {
    const uint count = g.blockSize * g.blockSize;
    return (t * g.raysPerBlock + count - 1u) / count;
}

// The ray in whose run texel t lies, where rays are fewer than texels.
uint nearestRay(GatherLayout g, uint t) { return ((t + 1u) * g.raysPerBlock - 1u) / (g.blockSize * g.blockSize); }

uvec2 texelOf(GatherLayout g, uvec2 block, uint t) { return block * g.blockSize + mortonInverse(t); }

// Direction of ray j: a point of the unit square, to be mapped to the hemisphere.
vec2 raySample(GatherLayout g, uvec2 block, uint j) { return sobol2(morton(block) * g.raysPerBlock + j, g.seed); }

#endif
