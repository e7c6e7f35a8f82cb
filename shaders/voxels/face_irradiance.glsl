// Irradiance of voxels by face, for lookups at many hits (host: passes/common/voxels/face_irradiance.h).
#ifndef VOXRAY_FACE_IRRADIANCE_GLSL
#define VOXRAY_FACE_IRRADIANCE_GLSL

// By voxel and face: irradiance and area, as faceLight() returns them.
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer FaceIrradiance { vec4 data[]; };
layout(scalar) readonly buffer FaceIrradianceRef { FaceIrradiance faceIrradiance; };

vec4 faceLight(uint number, ivec3 voxel, uint face) { return faceIrradiance.data[number * 6u + face]; }

#include "shaders/voxels/face_lookup.glsl"

#endif
