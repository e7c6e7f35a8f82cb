// Offsets of ray origins from surfaces, so that rays don't hit the surface that they start from.
#ifndef VOXRAY_SURFACE_OFFSET_GLSL
#define VOXRAY_SURFACE_OFFSET_GLSL

#include "shaders/scene/scene_types.h"

float largestCoordinate(vec3 p) { return max(abs(p.x), max(abs(p.y), abs(p.z))); }

// Error bound of a point that belongs to no triangle, m; never 0.
float pointOffset(vec3 position) { return COORDINATE_ERROR * max(largestCoordinate(position), 1.0e-20); }

// Error bound of a triangle's points along its unit normal, m: the errors along the axes, projected onto the normal
// (PBRT 6.8.5). That of a horizontal plane depends on its height only, not on its extent.
float planeOffset(vec3 a, vec3 b, vec3 c, vec3 normal) {
    return COORDINATE_ERROR * dot(abs(normal), max(abs(a), max(abs(b), abs(c))));
}

// Length of a shadow ray to a point `distance_` away, m: it ends before the point by twice the larger error of its two
// ends. `offset`: error bound of that point.
float shadowRayLength(float distance_, float offset, vec3 from) {
    return distance_ - 2.0 * max(offset, pointOffset(from));
}

#endif
