// Which face of a voxel a ray that meets it sees.
#ifndef VOXRAY_SEEN_FACE_GLSL
#define VOXRAY_SEEN_FACE_GLSL

#include "shaders/voxels/voxels.glsl"

#define NO_SEEN_FACE 6u

// Whether the surfaces in a voxel look one way: their mean normal is long.
bool isFlat(VoxelMaterial m) { return dot(m.normal, m.normal) > 0.75; }

// One of the three faces that look against the ray, picked by `random` in [0, 1) in proportion to what their surfaces project. Of one
// plane the faces are those before the side that the ray comes from. NO_SEEN_FACE where no surface
// with open space before it looks that way: the ray comes from behind, as from a face's own neighbours, and goes on.
uint seenFace(VoxelMaterial m, vec3 direction, float random) {
    const vec3 against = isFlat(m) ? (dot(m.normal, direction) > 0.0 ? -m.normal : m.normal) : -direction;
    const bvec3 isNegative = lessThan(against, vec3(0.0));
    const vec3 area = mix(m.unoccludedPositive, m.unoccludedNegative, isNegative);
    const vec3 projected = abs(against) * area;
    const float sum = projected.x + projected.y + projected.z;
    if (sum <= 0.0) return NO_SEEN_FACE;
    const float at = random * sum;
    const uint axis = at < projected.x ? 0u : at < projected.x + projected.y || projected.z == 0.0 ? 1u : 2u;
    return 2u * axis + (isNegative[axis] ? 1u : 0u);
}

#endif
