#version 460
#extension GL_GOOGLE_include_directive : require
// Irradiance of each face of a side: the mean of its surfels', by the area that the face has of them. A thread takes a side.
#include "shaders/clusters/patches.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/face.glsl"
layout(local_size_x = 64) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FaceValues { vec3 data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer SurfelValues { vec3 data[]; };
layout(scalar) readonly buffer Sides { SurfaceSide data[]; } sides;
layout(scalar) readonly buffer PlacedAt { SurfelValues placed; };
layout(scalar) readonly buffer SidesDirectAt { FaceValues sidesDirect; };
layout(push_constant) uniform Push { uint count; } push;

void main() {
    const uint side = linearIndex();
    if (side >= push.count) return;
    vec4 sum[6];
    for (uint face = 0u; face < 6u; ++face) sum[face] = vec4(0.0);
    const uint first = sides.data[side].firstSurfel;
    for (uint i = first; i < first + sides.data[side].surfels; ++i) {
        const vec3 normal = patchSurfels.data[i].normal;
        for (uint axis = 0u; axis < 3u; ++axis)
            sum[faceOf(normal, axis)] += normal[axis] * normal[axis] * vec4(placed.data[i], 1.0);
    }
    for (uint face = 0u; face < 6u; ++face)
        sidesDirect.data[6u * side + face] = sum[face].w > 0.0 ? sum[face].rgb / sum[face].w : vec3(0.0);
}
