// Irradiance of the faces that gather rays hit (host: passes/cache/hit_faces/hit_face_light.h).
#ifndef VOXRAY_HIT_FACE_LIGHT_GLSL
#define VOXRAY_HIT_FACE_LIGHT_GLSL

#include "passes/cache/hit_faces/hit_face.glsl"

layout(scalar) readonly buffer HitFaceIrradiance { vec4 data[]; } hitFaceIrradiance;  // W/m², by number; w: 1 where lit.

// Irradiance of the face at a surface point, for the side that the unit normal points to; black, and `known` is false,
// where the face is not lit.
vec3 hitFaceIrradianceAt(vec3 position, vec3 normal, out bool known) {
    const uint number = faceNumber(hitFace(position, normal));
    const vec4 irradiance = number == NO_FACE ? vec4(0.0) : hitFaceIrradiance.data[number];
    known = irradiance.w > 0.0;
    return irradiance.rgb;
}

#endif
