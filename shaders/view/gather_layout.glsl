// The texel that a gather ray starts from, and its sample of the frame's low-discrepancy sequence.
//
// Blocks of texels in Morton order use consecutive ranges of the sequence (Ahmed and Wonka 2020), and the texels of a
// block consecutive ranges of the block's. Aligned ranges of an Owen-scrambled Sobol sequence are stratified, so that
// the rays of a texel, of a block and of any larger square of blocks are well distributed.
#ifndef VOXRAY_GATHER_LAYOUT_GLSL
#define VOXRAY_GATHER_LAYOUT_GLSL

#include "shaders/scene/morton.glsl"
#include "shaders/scene/sampling.glsl"
#include "shaders/view/gather_types.h"

// Index in the block, in Morton order, of the texel that ray j starts from. Where a block has fewer rays than texels, a
// ray represents a range of texels and starts from a random one of them: the same one in all blocks would alias with
// the filter, whose strides are powers of two.
uint rayTexel(GatherLayout g, uvec2 block, uint j) {
    const uint count = g.blockSize * g.blockSize;
    const uint first = j * count / g.raysPerBlock;
    if (g.raysPerBlock >= count) return first;
    const uint texels = (j + 1u) * count / g.raysPerBlock - first;
    return first + hashCombine(g.seed ^ 0x5bd1e995u, morton(block) * g.raysPerBlock + j) % texels;
}

// The first ray of a block that starts from texel t or a later one: ceil(t * rays / count). Where a block has as many
// rays as texels or more.
uint firstRay(GatherLayout g, uint t) {
    const uint count = g.blockSize * g.blockSize;
    return (t * g.raysPerBlock + count - 1u) / count;
}

// The ray that represents texel t, where a block has fewer rays than texels.
uint nearestRay(GatherLayout g, uint t) { return ((t + 1u) * g.raysPerBlock - 1u) / (g.blockSize * g.blockSize); }

// The rays of texel t, the first and the one after the last: a run of the block's rays, or at most one where texels
// outnumber rays.
uvec2 texelRays(GatherLayout g, uvec2 block, uint t) {
    if (g.raysPerBlock >= g.blockSize * g.blockSize) return uvec2(firstRay(g, t), firstRay(g, t + 1u));
    const uint nearest = nearestRay(g, t);
    return uvec2(nearest, nearest + (rayTexel(g, block, nearest) == t ? 1u : 0u));
}

uvec2 texelOf(GatherLayout g, uvec2 block, uint t) { return block * g.blockSize + mortonInverse(t); }

// Sample of ray j in the unit square, to be mapped to the hemisphere.
vec2 raySample(GatherLayout g, uvec2 block, uint j) { return sobol2(morton(block) * g.raysPerBlock + j, g.seed); }

#endif
