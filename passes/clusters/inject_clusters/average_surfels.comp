// Averages the direct irradiance of each patch over its group's surfels, weighted by their area at its face.
#include "passes/clusters/group_patches.glsl"
#include "passes/surfels/surfel_points.glsl"
#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/radiosity.glsl"
#include "shaders/voxels/face.glsl"
layout(local_size_x = 64) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer SurfelValues { vec3 data[]; };
layout(scalar) readonly buffer Groups { SurfaceGroup data[]; } groups;
layout(scalar) readonly buffer SurfelIdsRef { LargeUints surfelIds; };
layout(scalar) readonly buffer SurfelIrradianceRef { SurfelValues surfelIrradiance; };
layout(scalar) readonly buffer PatchDirectRef { LargeUints patchDirect; };
layout(push_constant) uniform Push {
    uint count;
    uint pointSeed;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const SurfaceGroup group = groups.data[i];
    vec4 sums[6];
    for (uint face = 0u; face < 6u; ++face) sums[face] = vec4(0.0);
    const uint end = groups.data[i + 1u].firstSurfel;
    for (uint k = group.firstSurfel; k < end; ++k) {
        const vec3 normal = surfelGeometry(surfelIds.data[k], push.pointSeed).normal;
        for (uint axis = 0u; axis < 3u; ++axis)
            sums[faceOf(normal, axis)] += normal[axis] * normal[axis] * vec4(surfelIrradiance.data[k], 1.0);
    }
    for (uint face = 0u; face < 6u; ++face)
        if (hasPatch(group, face))
            patchDirect.data[patchIndex(group, face)] =
                packRadiosity(sums[face].w > 0.0 ? sums[face].rgb / sums[face].w : vec3(0.0));
}
