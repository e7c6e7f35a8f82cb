// Moves what patches see together: a thread takes a patch.
#include "passes/clusters/seen_types.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Targets { uint data[]; } targets;
layout(scalar) readonly buffer First { uint data[]; } first;
layout(scalar) buffer Seen { uint data[]; } seen;  // 0 before.
layout(push_constant, scalar) uniform Push {
    SeenLayout lists;
    uint patches;
} push;

void main() {
    const uint number = linearIndex();
    if (number >= push.patches) return;
    const uint begin = first.data[number], end = first.data[number + 1u];
    for (uint i = begin; i < end; ++i) {
        const uint entry = targets.data[number * push.lists.raysPerPatch + i - begin];
        const uint bit = i * push.lists.entryBits, word = bit / 32u, shift = bit % 32u;
        // A word may hold entries of two patches
        atomicOr(seen.data[word], entry << shift);
        if (shift + push.lists.entryBits > 32u) atomicOr(seen.data[word + 1u], entry >> (32u - shift));
    }
}
