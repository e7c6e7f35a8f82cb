// Irradiance of patches out of what they see: rays are distributed by the cosine, so it is the mean of the radiosity that they meet
// (Cosin and Patow 2022, section 4.4, whose form factors are of points; these are counted).
#ifndef VOXRAY_GATHER_PATCH_GLSL
#define VOXRAY_GATHER_PATCH_GLSL

#include "passes/clusters/seen_list.glsl"
#include "passes/surfels/radiosity.glsl"

layout(scalar) readonly buffer PartRadiosity { uint data[]; } partRadiosity;
layout(scalar) readonly buffer PatchRadiosityAt { LargeUints patchRadiosity; };

// W/m²
vec3 gatherPatch(SeenLayout lists, uint number) {
    vec3 sum = vec3(0.0);
    for (SeenWalk w = walkSeen(lists, number); nextSeen(lists, w);) {
        const uint target = seenTarget(lists, w.entry);
        const uint radiosity =
            target < lists.sideTargets ? partRadiosity.data[target] : patchRadiosity.data[target - lists.sideTargets];
        sum += float(seenRays(lists, w.entry)) * unpackRadiosity(radiosity);
    }
    return sum / float(lists.raysPerPatch);
}

#endif
