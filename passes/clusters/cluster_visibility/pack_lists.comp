// Packs the visibility lists of patches without padding, entryBits bits for each entry.
#include "passes/clusters/visibility_list_types.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Targets { uint data[]; } targets;  // Output of merge_targets.comp.
layout(scalar) readonly buffer Offsets { uint data[]; } offsets;
layout(scalar) buffer Entries { uint data[]; } entries;  // Must be 0 before.
layout(push_constant, scalar) uniform Push {
    VisibilityListLayout listLayout;
    uint patchCount;
} push;

void main() {
    const uint number = linearIndex();
    if (number >= push.patchCount) return;
    const uint first = offsets.data[number], end = offsets.data[number + 1u];
    for (uint i = first; i < end; ++i) {
        const uint entry = targets.data[number * push.listLayout.raysPerPatch + i - first];
        const uint bit = i * push.listLayout.entryBits, word = bit / 32u, shift = bit % 32u;
        // A word may hold entries of two patches
        atomicOr(entries.data[word], entry << shift);
        if (shift + push.listLayout.entryBits > 32u) atomicOr(entries.data[word + 1u], entry >> (32u - shift));
    }
}
