#version 460
#extension GL_GOOGLE_include_directive : require
// Radiosity of each face of each side (whose materials are bound): reflectance times irradiance. A thread takes a face.
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FaceValues { vec3 data[]; };
layout(scalar) readonly buffer ArrivingAt { FaceValues arriving; };  // Irradiance before the first bounce, W/m².
layout(scalar) readonly buffer BouncedAt { FaceValues bounced; };    // After it, W/m².
layout(scalar) readonly buffer RadiosityAt { FaceValues radiosity; };
layout(push_constant) uniform Push {
    uint faces;
    uint hasBounced;
} push;

void main() {
    const uint face = linearIndex();
    if (face >= push.faces) return;
    vec3 irradiance = arriving.data[face];
    if (push.hasBounced == 1u) irradiance += bounced.data[face];
    radiosity.data[face] = voxelMaterial(face / 6u).albedo * irradiance;
}
