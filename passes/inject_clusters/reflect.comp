#version 460
#extension GL_GOOGLE_include_directive : require
// Radiosity of each face of each voxel: reflectance times irradiance. Where the injection did not look, of what has bounced alone. A
// thread takes a face.
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/packed_flux.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FaceValues { vec3 data[]; };
layout(scalar) buffer DirectAt { LargeUints direct; };
layout(scalar) buffer IndirectAt { LargeUints indirect; };
layout(scalar) readonly buffer Area { uint data[]; } area;
layout(scalar) readonly buffer BouncedAt { FaceValues bounced; };  // Irradiance, W/m².
layout(scalar) readonly buffer RadiosityAt { FaceValues radiosity; };
layout(push_constant) uniform Push {
    uint faces;
    float voxelFaceArea;  // m²
    uint hasBounced;
} push;

void main() {
    const uint face = linearIndex();
    if (face >= push.faces) return;
    const float known = areaOf(area.data[face / 2u], face) * push.voxelFaceArea;
    vec3 irradiance = known > 0.0 ? (loadFlux(direct, face) + loadFlux(indirect, face)) / known : vec3(0.0);
    if (push.hasBounced == 1u) irradiance += bounced.data[face];
    radiosity.data[face] = voxelMaterial(face / 6u).albedo * irradiance;
}
