#version 460
#extension GL_GOOGLE_include_directive : require
// Irradiance of each face of each side: what was injected into its voxel. None where the injection did not look. Where that
// has less than SMALL_FACE_AREA, no more than its flux over so much: the ratio of two small samples could outshine a scene. A thread
// takes a face.
#include "shaders/clusters/patch_types.h"
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/packed_flux.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FaceValues { vec3 data[]; };
layout(scalar) readonly buffer Sides { SurfaceSide data[]; } sides;
layout(scalar) buffer DirectAt { LargeUints direct; };
layout(scalar) buffer IndirectAt { LargeUints indirect; };
layout(scalar) readonly buffer Area { uint data[]; } area;
layout(scalar) readonly buffer SidesDirectAt { FaceValues sidesDirect; };
layout(scalar) readonly buffer ArrivingAt { FaceValues arriving; };  // Direct and indirect, W/m².
layout(push_constant) uniform Push {
    uint faces;
    float voxelFaceArea;  // m²
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.faces) return;
    const uint face = 6u * sides.data[i / 6u].voxel + i % 6u;
    const float sampled = areaOf(area.data[face / 2u], face);
    const float known = sampled > 0.0 ? max(sampled, SMALL_FACE_AREA) * push.voxelFaceArea : 0.0;
    const vec3 own = known > 0.0 ? loadFlux(direct, face) / known : vec3(0.0);
    sidesDirect.data[i] = own;
    arriving.data[i] = known > 0.0 ? own + loadFlux(indirect, face) / known : vec3(0.0);
}
