// Irradiance of each patch: the mean of its side's surfels', by the area that its face has of them. A thread takes a side.
#include "passes/clusters/patches.glsl"
#include "passes/clusters/side_patches.glsl"
#include "shaders/compute/large_buffer.glsl"
#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/radiosity.glsl"
#include "shaders/voxels/face.glsl"
layout(local_size_x = 64) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer SurfelValues { vec3 data[]; };
layout(scalar) readonly buffer Sides { SurfaceSide data[]; } sides;
layout(scalar) readonly buffer PlacedAt { SurfelValues placed; };
layout(scalar) readonly buffer PatchDirectAt { LargeUints patchDirect; };
layout(push_constant) uniform Push { uint count; } push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const SurfaceSide side = sides.data[i];
    vec4 sum[6];
    for (uint face = 0u; face < 6u; ++face) sum[face] = vec4(0.0);
    for (uint k = side.firstSurfel; k < side.firstSurfel + side.surfels; ++k) {
        const vec3 normal = patchSurfels.data[k].normal;
        for (uint axis = 0u; axis < 3u; ++axis)
            sum[faceOf(normal, axis)] += normal[axis] * normal[axis] * vec4(placed.data[k], 1.0);
    }
    for (uint face = 0u; face < 6u; ++face)
        if (hasPatch(side, face))
            patchDirect.data[patchAt(side, face)] = packRadiosity(sum[face].w > 0.0 ? sum[face].rgb / sum[face].w : vec3(0.0));
}
