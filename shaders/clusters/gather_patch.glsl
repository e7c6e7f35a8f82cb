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

// W/m²
vec3 gatherPatch(SeenLayout lists, uint number) {
    SeenChunk chunk = seenChunks.data[number / lists.patchesPerChunk];
    const uint i = number % lists.patchesPerChunk;
    const uint end = chunk.first.data[i + 1u];
    vec3 sum = vec3(0.0);
    for (uint k = chunk.first.data[i]; k < end; ++k) {
        const uint seen = chunk.seen.data[k], target = seenTarget(seen);
        const uint radiosity =
            target < lists.sideTargets ? partRadiosity.data[target] : patchRadiosity.data[target - lists.sideTargets];
        sum += float(seenRays(seen)) * unpackRadiosity(radiosity);
    }
    return sum / float(lists.raysPerPatch);
}

#endif
