// The voxel face that stands for the surface where a ray hit, and its number among the faces that are lit.
#ifndef VOXRAY_HIT_FACE_GLSL
#define VOXRAY_HIT_FACE_GLSL

#include "shaders/voxels/face.glsl"
#include "shaders/voxels/voxel_levels.glsl"

#define NO_FACE 0xffffffffu  // In place of a face or of its number.

// By face: its number among the lit ones, or NO_FACE (passes/final_gather/hit_faces/hit_face_light.h).
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FaceNumbers { uint data[]; };
layout(scalar) readonly buffer FaceNumbersRef { FaceNumbers faceNumbers; };

// Of a surface point and the unit geometric normal on the side that was hit: 6 * voxel + the face that the normal
// passes, so that a face has no more than one side of a plane. NO_FACE where no voxel is near.
uint hitFace(vec3 position, vec3 normal) {
    const uint voxel = nearestVoxel(gridAt(position), position);
    if (voxel == NO_VOXEL) return NO_FACE;
    const vec3 size = abs(normal);
    const uint axis = size.x >= size.y && size.x >= size.z ? 0u : size.y >= size.z ? 1u : 2u;
    return 6u * voxel + faceOf(normal, axis);
}

// The same normal, given the face and the triangle's normal of either sign.
vec3 normalAtFace(vec3 normal, uint face) {
    return (normal[face % 6u >> 1] < 0.0) == ((face & 1u) == 1u) ? normal : -normal;
}

uint faceNumber(uint face) { return face == NO_FACE ? NO_FACE : faceNumbers.data[face]; }

#endif
