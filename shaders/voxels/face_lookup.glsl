// Irradiance at a point of a surface, from the irradiance of voxels by face. The including file has defined
//     vec4 faceLight(uint number, ivec3 voxel, uint face)
// For a face, +x -x +y -y +z -z, of an occupied voxel (its number and its coordinates): mean irradiance, W/m², and the
// area that it is the mean over, in units of a voxel's face; 0 where it is unknown.
#ifndef VOXRAY_FACE_LOOKUP_GLSL
#define VOXRAY_FACE_LOOKUP_GLSL

#include "shaders/voxels/face.glsl"
#include "shaders/voxels/voxels.glsl"

// Adds a voxel's irradiance times area, and area, of the three faces that a normal faces, weighted by its squared
// components. In a grid of one direction all six faces have equal weights.
void addFaces(VoxelGrid g, ivec3 voxel, vec3 normal, inout vec3 sum, inout float area) {
    const uint number = voxelNumber(g, voxel);
    if (number == NO_VOXEL) return;
    const bool isIsotropic = g.directions == 1u;
    for (uint k = 0u; k < (isIsotropic ? 6u : 3u); ++k) {
        const float weight = isIsotropic ? 1.0 : normal[k] * normal[k];
        if (weight < 1e-6) continue;
        const vec4 light = faceLight(number, voxel, isIsotropic ? k : faceOf(normal, k));
        sum += weight * light.w * light.rgb;
        area += weight * light.w;
    }
}

// Irradiance at a point of a surface with a unit normal, without interpolation. Where its voxel has less than
// SMALL_FACE_AREA of surface that faces the same way, the mean includes the 26 adjacent voxels. Where that area is not
// above MIN_FACE_AREA, it is black, and `known` is false.
vec3 irradianceAt(VoxelGrid g, vec3 position, vec3 normal, out bool known) {
    const ivec3 voxel = voxelAt(g, position);
    vec3 sum = vec3(0.0);
    float area = 0.0;
    addFaces(g, voxel, normal, sum, area);
    for (int i = 0; i < 27 && area < SMALL_FACE_AREA; ++i) {
        if (i == 13) continue;
        addFaces(g, voxel + ivec3(i % 3, (i / 3) % 3, i / 9) - 1, normal, sum, area);
    }
    known = area > MIN_FACE_AREA;
    return known ? sum / area : vec3(0.0);
}

// The same, trilinearly interpolated for surfaces that are directly visible: irradiance times area and area are
// interpolated separately, so that voxels with little surface have little weight.
vec3 interpolatedIrradianceAt(VoxelGrid g, vec3 position, vec3 normal, out bool known) {
    const vec3 center = (position - g.origin) / g.voxelSize - 0.5, corner = floor(center), fraction = center - corner;
    vec3 sum = vec3(0.0);
    float area = 0.0;
    for (int i = 0; i < 8; ++i) {
        const ivec3 offset = ivec3(i & 1, (i >> 1) & 1, i >> 2);
        const vec3 tent = mix(1.0 - fraction, fraction, vec3(offset));
        vec3 voxelSum = vec3(0.0);
        float voxelArea = 0.0;
        addFaces(g, ivec3(corner) + offset, normal, voxelSum, voxelArea);
        sum += tent.x * tent.y * tent.z * voxelSum;
        area += tent.x * tent.y * tent.z * voxelArea;
    }
    if (area < SMALL_FACE_AREA) return irradianceAt(g, position, normal, known);
    known = true;
    return sum / area;
}

#endif
