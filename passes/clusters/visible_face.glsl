// The faces of a voxel's surfaces that are visible to a ray.
#ifndef VOXRAY_VISIBLE_FACE_GLSL
#define VOXRAY_VISIBLE_FACE_GLSL

#include "shaders/voxels/face.glsl"
#include "shaders/voxels/voxels.glsl"

// Whether the normals of the surfaces agree, so that their mean is long.
bool isFlat(VoxelMaterial m) { return dot(m.normal, m.normal) > 0.75; }

// The normal of the surfaces, flipped towards the origin of the ray.
vec3 normalAgainst(VoxelMaterial m, vec3 direction) {
    if (!isFlat(m)) return -direction;
    return dot(m.normal, direction) > 0.0 ? -m.normal : m.normal;
}

// Projected unoccluded area of the surfaces at each of the three faces towards the origin of a ray. All are 0 where the
// ray hits the surfaces from behind.
vec3 projectedFaceAreas(VoxelMaterial m, vec3 direction) {
    const vec3 normal = normalAgainst(m, direction);
    return abs(normal) * mix(m.unoccludedPositive, m.unoccludedNegative, lessThan(normal, vec3(0.0)));
}

// One of these faces, with probability proportional to its projected area. `random` in [0, 1); not all areas are 0.
uint pickFace(VoxelMaterial m, vec3 direction, vec3 projected, float random) {
    const float threshold = random * (projected.x + projected.y + projected.z);
    const uint axis = threshold < projected.x                                      ? 0u
                      : threshold < projected.x + projected.y || projected.z == 0.0 ? 1u
                                                                                    : 2u;
    return faceOf(normalAgainst(m, direction), axis);
}

#endif
