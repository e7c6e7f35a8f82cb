// Stores which surfels of a batch exist and which of them are occluded: a word for SURFELS_PER_WORD of them.
#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/surfel_points.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Rays { Ray data[]; } rays;
readonly buffer Occluded { uint data[]; } occluded;
layout(scalar) readonly buffer SidesRef { LargeUints sides; };
buffer Count { uint value; } count;  // Surfels that exist.
layout(push_constant) uniform Push {
    uint firstWord;
    uint candidateCount;
    uint includeOccluded;  // 0 or 1.
} push;

uint candidateSide(uint candidate) {
    if (rays.data[candidate].tMax < 0.0) return SURFEL_NONE;
    if (occluded.data[candidate] == 0u) return SURFEL_OPEN;
    return push.includeOccluded == 1u ? SURFEL_OCCLUDED : SURFEL_NONE;
}

void main() {
    const uint i = linearIndex(), first = SURFELS_PER_WORD * i;
    if (first >= push.candidateCount) return;
    uint word = 0u, existing = 0u;
    for (uint k = 0u; k < SURFELS_PER_WORD && first + k < push.candidateCount; ++k) {
        const uint side = candidateSide(first + k);
        word |= side << 2u * k;
        if (side != SURFEL_NONE) ++existing;
    }
    sides.data[push.firstWord + i] = word;
    atomicAdd(count.value, existing);
}
