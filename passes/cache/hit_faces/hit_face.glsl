// The face that stands for the surface where a ray hit, of a surface voxel or (CACHE_CELLS) a cell of a radiance cache, and
// its number among the faces that are lit.
#ifndef VOXRAY_HIT_FACE_GLSL
#define VOXRAY_HIT_FACE_GLSL

#include "passes/cache/hit_faces/face_point_types.h"
#ifdef CACHE_CELLS
#include "passes/cache/radiance_cache.glsl"
#else
#include "shaders/voxels/face.glsl"
#include "shaders/voxels/voxel_levels.glsl"
#endif

// By face: its number among the lit ones, or NO_FACE (passes/cache/hit_faces/hit_face_light.h).
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FaceNumbers { uint data[]; };
layout(scalar) readonly buffer FaceNumbersRef { FaceNumbers faceNumbers; };

#ifdef CACHE_CELLS
// Of a surface point and the unit geometric normal on the side that was hit: the slot of its cell, which is inserted where
// the cache has none. NO_FACE where the cell finds no slot.
uint hitFace(vec3 position, vec3 normal) {
    bool isNew;
    uint collisions;
    return insertRadianceCell(radianceCacheGrid.data, radianceCacheKey(radianceCacheGrid.data, position, normal), isNew,
                              collisions);
}

// As faceOf(): +x -x +y -y +z -z.
uint sideOfFace(uint face) {
    const uint bins = radianceCacheGrid.data.normalBins;
    return uint(radianceCacheKeys.data[face] >> 56) / (bins * bins);
}
#else
// Of a surface point and the unit geometric normal on the side that was hit: 6 * voxel + the face that the normal
// passes, so that a face has no more than one side of a plane. NO_FACE where no voxel is near.
uint hitFace(vec3 position, vec3 normal) {
    const uint voxel = nearestVoxel(gridAt(position), position);
    if (voxel == NO_VOXEL) return NO_FACE;
    const vec3 size = abs(normal);
    const uint axis = size.x >= size.y && size.x >= size.z ? 0u : size.y >= size.z ? 1u : 2u;
    return 6u * voxel + faceOf(normal, axis);
}

uint sideOfFace(uint face) { return face % 6u; }
#endif

// The same normal, given the face and the triangle's normal of either sign.
vec3 normalAtFace(vec3 normal, uint face) {
    const uint side = sideOfFace(face);
    return (normal[side >> 1] < 0.0) == ((side & 1u) == 1u) ? normal : -normal;
}

uint faceNumber(uint face) { return face == NO_FACE ? NO_FACE : faceNumbers.data[face]; }

#endif
