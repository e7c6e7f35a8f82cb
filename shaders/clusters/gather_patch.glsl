// Irradiance of patches out of what they see: rays are distributed by the cosine, so it is the mean of the radiosity that they meet
// (Cosin and Patow 2022, section 4.4, whose form factors are of points; these are counted).
#ifndef VOXRAY_GATHER_PATCH_GLSL
#define VOXRAY_GATHER_PATCH_GLSL

#include "shaders/clusters/seen_types.h"
#include "shaders/compute/large_buffer.glsl"
#include "shaders/surfels/radiosity.glsl"

struct SeenChunk {
    LargeUints first;  // Where each patch's list begins, and where the last one ends.
    LargeUints seen;
};
layout(scalar) readonly buffer SeenChunks { SeenChunk data[]; } seenChunks;
layout(scalar) readonly buffer PartRadiosity { uint data[]; } partRadiosity;
layout(scalar) readonly buffer PatchRadiosityAt { LargeUints patchRadiosity; };

uint shiftedRight(uint word, uint bits) { return bits < 32u ? word >> bits : 0u; }

// W/m²
vec3 gatherPatch(SeenLayout lists, uint number) {
    SeenChunk chunk = seenChunks.data[number / lists.patchesPerChunk];
    const uint i = number % lists.patchesPerChunk;
    const uint begin = chunk.first.data[i], end = chunk.first.data[i + 1u];
    vec3 sum = vec3(0.0);
    if (begin == end) return sum;
    // Each word is read once, for on software Vulkan reads are what a list costs: what is left of it waits for the next entry.
    const uint bits = lists.entryBits, shift = begin * bits % 32u;
    uint word = begin * bits / 32u, held = 32u - shift, left = chunk.seen.data[word] >> shift;
    for (uint k = begin; k < end; ++k) {
        uint entry = left;
        if (held < bits) {
            const uint next = chunk.seen.data[++word];
            entry |= next << held;
            left = shiftedRight(next, bits - held);
            held += 32u;
        } else {
            left = shiftedRight(left, bits);
        }
        held -= bits;
        entry = bitfieldExtract(entry, 0, int(bits));
        const uint target = seenTarget(lists, entry);
        const uint radiosity =
            target < lists.sideTargets ? partRadiosity.data[target] : patchRadiosity.data[target - lists.sideTargets];
        sum += float(seenRays(lists, entry)) * unpackRadiosity(radiosity);
    }
    return sum / float(lists.raysPerPatch);
}

#endif
