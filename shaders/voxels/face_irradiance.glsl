// Light that voxels hold by face, direct and indirect together, for lookups by many rays: the mean of the voxel itself, without
// interpolation.
#ifndef VOXRAY_FACE_IRRADIANCE_GLSL
#define VOXRAY_FACE_IRRADIANCE_GLSL

#include "shaders/voxels/face.glsl"
#include "shaders/voxels/voxels.glsl"

// By voxel and face +x -x +y -y +z -z: irradiance in W/m² and the area in units of a voxel's face that it is the
// mean over; 0 where nothing is known.
layout(scalar) readonly buffer FaceIrradiance { vec4 data[]; } faceIrradiance;

// Adds a voxel's irradiance times area for a normal, by the squared components of the normal. In a grid of one direction all
// six faces of a voxel count alike.
void addFaces(VoxelGrid g, uint voxel, vec3 normal, inout vec3 sum, inout float area) {
    if (g.directions == 1u) {
        for (uint k = 0u; k < 6u; ++k) {
            const vec4 face = faceIrradiance.data[voxel * 6u + k];
            sum += face.w * face.rgb;
            area += face.w;
        }
        return;
    }
    for (uint axis = 0u; axis < 3u; ++axis) {
        const float weight = normal[axis] * normal[axis];
        if (weight < 1e-6) continue;
        const vec4 face = faceIrradiance.data[voxel * 6u + faceOf(normal, axis)];
        sum += weight * face.w * face.rgb;
        area += weight * face.w;
    }
}

// Irradiance at a point of a surface with unit normal `normal`. Where its voxel has too little surface that faces the
// same way (under a twentieth of a voxel's face: areas and flux are sampled, and the ratio of two small samples is noise), the
// voxels around it are taken together. Where they know nothing either, it is black and `known` is false.
vec3 irradianceAt(VoxelGrid g, vec3 position, vec3 normal, out bool known) {
    const ivec3 cell = voxelAt(g, position);
    vec3 sum = vec3(0.0);
    float area = 0.0;
    const uint own = voxelNumber(g, cell);
    if (own != NO_VOXEL) addFaces(g, own, normal, sum, area);
    for (int i = 0; i < 27 && area < 0.05; ++i) {
        if (i == 13) continue;
        const uint voxel = voxelNumber(g, cell + ivec3(i % 3, (i / 3) % 3, i / 9) - 1);
        if (voxel != NO_VOXEL) addFaces(g, voxel, normal, sum, area);
    }
    known = area > 0.0;
    return known ? sum / area : vec3(0.0);
}

#endif
