// Which face of a voxel's surfaces a ray that meets them sees.
#ifndef VOXRAY_SEEN_FACE_GLSL
#define VOXRAY_SEEN_FACE_GLSL

#include "shaders/voxels/face.glsl"
#include "shaders/voxels/voxels.glsl"

// Whether the surfaces look one way: their mean normal is long.
bool isFlat(VoxelMaterial m) { return dot(m.normal, m.normal) > 0.75; }

// The way that the side looks that a ray meets: of one plane the one that the ray comes from.
vec3 wayAgainst(VoxelMaterial m, vec3 direction) {
    if (!isFlat(m)) return -direction;
    return dot(m.normal, direction) > 0.0 ? -m.normal : m.normal;
}

// What the surfaces project of each of the three faces that look against a ray. Nothing where no surface with open space before it
// looks that way: the ray comes from behind, as from a face's own neighbours.
vec3 projectedArea(VoxelMaterial m, vec3 direction) {
    const vec3 against = wayAgainst(m, direction);
    return abs(against) * mix(m.unoccludedPositive, m.unoccludedNegative, lessThan(against, vec3(0.0)));
}

// One of these faces, picked by `random` in [0, 1) in proportion to what they project, not all nothing.
uint faceAgainst(VoxelMaterial m, vec3 direction, vec3 projected, float random) {
    const float at = random * (projected.x + projected.y + projected.z);
    const uint axis = at < projected.x ? 0u : at < projected.x + projected.y || projected.z == 0.0 ? 1u : 2u;
    return faceOf(wayAgainst(m, direction), axis);
}

#endif
