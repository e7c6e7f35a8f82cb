// How far off a surface a ray begins, so that it does not meet the surface again.
#ifndef VOXRAY_SURFACE_OFFSET_GLSL
#define VOXRAY_SURFACE_OFFSET_GLSL

#include "shaders/scene/scene_types.h"

float largestCoordinate(vec3 p) { return max(abs(p.x), max(abs(p.y), abs(p.z))); }

// Of a point that belongs to no triangle, m; never 0.
float pointOffset(vec3 position) { return COORDINATE_ERROR * max(largestCoordinate(position), 1.0e-20); }

// What rounding may move the points of a triangle along its unit normal, m: coordinates are as uncertain as those of the triangle's
// corners are, each along its own axis (as Pharr, Jakob and Humphreys 2023, section 6.8.5). Ground that lies level is certain however
// far it reaches.
float planeOffset(vec3 a, vec3 b, vec3 c, vec3 normal) { return COORDINATE_ERROR * dot(abs(normal), max(abs(a), max(abs(b), abs(c)))); }

// How far a ray from one point is traced towards another, `distance_` away, m, so that it does not meet the surface there. `offset`: of
// that point. Where the ray meets that surface is as uncertain as the coordinates of both ends are.
float shadowRayLength(float distance_, float offset, vec3 from) { return distance_ - 2.0 * max(offset, pointOffset(from)); }

#endif
