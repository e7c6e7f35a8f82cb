// Irradiance at a point of a surface out of what voxels hold by face, without interpolation. Whoever includes this defines before
//     vec4 faceLight(uint number, ivec3 voxel, uint face)
// what a face, +x -x +y -y +z -z, of the occupied voxel at `voxel` with that number holds: irradiance in W/m², and the area in units
// of a voxel's face that it is the mean over; 0 where nothing is known.
#ifndef VOXRAY_FACE_LOOKUP_GLSL
#define VOXRAY_FACE_LOOKUP_GLSL

#include "shaders/voxels/face.glsl"
#include "shaders/voxels/voxels.glsl"

// Adds a voxel's irradiance times area for a normal, by the squared components of the normal. In a grid of one direction all
// six faces of a voxel count alike.
void addFaces(VoxelGrid g, ivec3 voxel, vec3 normal, inout vec3 sum, inout float area) {
    const uint number = voxelNumber(g, voxel);
    if (number == NO_VOXEL) return;
    const bool allAlike = g.directions == 1u;
    for (uint k = 0u; k < (allAlike ? 6u : 3u); ++k) {
        const float weight = allAlike ? 1.0 : normal[k] * normal[k];
        if (weight < 1e-6) continue;
        const vec4 light = faceLight(number, voxel, allAlike ? k : faceOf(normal, k));
        sum += weight * light.w * light.rgb;
        area += weight * light.w;
    }
}

// Irradiance at a point of a surface with unit normal `normal`. Where its voxel has too little surface that faces the same way
// (SMALL_FACE_AREA), the voxels around it are taken together. Where they know nothing either (MIN_FACE_AREA), it is black and
// `known` is false.
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

// The same with tent weights one voxel wide about the point, for surfaces that are looked at as they are: the mean over the eight
// voxels round it, by the area that they hold. A voxel that the surface only grazes weighs little.
vec3 interpolatedIrradianceAt(VoxelGrid g, vec3 position, vec3 normal, out bool known) {
    const vec3 center = (position - g.origin) / g.voxelSize - 0.5, corner = floor(center), part = center - corner;
    vec3 sum = vec3(0.0);
    float area = 0.0;
    for (int i = 0; i < 8; ++i) {
        const ivec3 far = ivec3(i & 1, (i >> 1) & 1, i >> 2);
        const vec3 tent = mix(1.0 - part, part, vec3(far));
        vec3 voxelSum = vec3(0.0);
        float voxelArea = 0.0;
        addFaces(g, ivec3(corner) + far, normal, voxelSum, voxelArea);
        sum += tent.x * tent.y * tent.z * voxelSum;
        area += tent.x * tent.y * tent.z * voxelArea;
    }
    if (area < SMALL_FACE_AREA) return irradianceAt(g, position, normal, known);
    known = true;
    return sum / area;
}

#endif
