// Light that voxels hold by face, direct and indirect together, for lookups by many rays: the mean of the voxel itself, without
// interpolation.
#ifndef VOXRAY_FACE_IRRADIANCE_GLSL
#define VOXRAY_FACE_IRRADIANCE_GLSL

// By voxel and face: as faceLight() of face_lookup.glsl.
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer FaceIrradiance { vec4 data[]; };
layout(scalar) readonly buffer FaceIrradianceRef { FaceIrradiance faceIrradiance; };

vec4 faceLight(uint number, ivec3 voxel, uint face) { return faceIrradiance.data[number * 6u + face]; }

#include "shaders/voxels/face_lookup.glsl"

#endif
