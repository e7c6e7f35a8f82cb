// Packs the visibility lists of patches without padding (visibility_list_types.h).
#include "passes/clusters/visibility_list_types.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Targets { uint data[]; } targets;  // Output of merge_targets.comp, as the next one.
layout(scalar) readonly buffer ListHeaders { uint data[]; } listHeaders;
layout(scalar) readonly buffer Offsets { uint data[]; } offsets;
layout(scalar) buffer Entries { uint data[]; } entries;  // Must be 0 before.
layout(push_constant, scalar) uniform Push {
    VisibilityListLayout listLayout;
    uint patchCount;
} push;

void store(uint value, uint bit, uint bits) {
    const uint word = bit / 32u, shift = bit % 32u;
    // A word may hold entries of two patches
    atomicOr(entries.data[word], value << shift);
    if (shift + bits > 32u) atomicOr(entries.data[word + 1u], value >> (32u - shift));
}

void main() {
    const uint number = linearIndex();
    if (number >= push.patchCount) return;
    const uint first = offsets.data[number], end = offsets.data[number + 1u];
    if (first == end) return;
    const uint header = listHeaders.data[number], rayBits = rayBitsOf(header), entryBits = targetBitsOf(header) + rayBits;
    store(header, first, LIST_HEADER_BITS);
    uint previous = 0u, i = number * push.listLayout.raysPerPatch;
    for (uint bit = first + LIST_HEADER_BITS; bit < end; bit += entryBits) {
        const uint entry = targets.data[i++], target = entry >> push.listLayout.rayBits;
        const uint raysLess1 = bitfieldExtract(entry, 0, int(push.listLayout.rayBits));
        store((target - previous) << rayBits | raysLess1, bit, entryBits);
        previous = target;
    }
}
