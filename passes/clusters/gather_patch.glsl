// Irradiance of a patch: the mean radiosity of what its cosine-distributed rays hit (Cosin and Patow 2022, section 4.4;
// the paper evaluates form factors between points, here rays are counted).
#ifndef VOXRAY_GATHER_PATCH_GLSL
#define VOXRAY_GATHER_PATCH_GLSL

#include "passes/clusters/visibility_list.glsl"
#include "passes/surfels/radiosity.glsl"

layout(scalar) readonly buffer ComponentRadiosity { uint data[]; } componentRadiosity;  // Per component face.
layout(scalar) readonly buffer PatchRadiosityRef { LargeUints patchRadiosity; };

// W/m²
vec3 gatherPatch(VisibilityListLayout lists, uint patchNumber) {
    vec3 sum = vec3(0.0);
    for (VisibilityListIterator it = visibilityListOf(lists, patchNumber); nextEntry(it);) {
        const uint radiosity = it.target < lists.firstPatchTarget
                                   ? componentRadiosity.data[it.target]
                                   : patchRadiosity.data[it.target - lists.firstPatchTarget];
        sum += float(it.rays) * unpackRadiosity(radiosity);
    }
    return sum / float(lists.raysPerPatch);
}

#endif
