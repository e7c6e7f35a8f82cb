// The ray with which a path of light goes on from a surfel.
#ifndef VOXRAY_PATH_RAY_GLSL
#define VOXRAY_PATH_RAY_GLSL

#include "shaders/scene/sampling.glsl"
#include "passes/surfels/surfel_types.h"
#include "shaders/trace/ray_types.h"

// Distributed by cosine about the surfel's normal; none where that leads below the surface, whose geometric normal (unit, on the
// surfel's side) may be another one.
Ray pathRay(Surfel s, vec3 geometricNormal, uint seed) {
    const vec3 direction = cosineDirection(sobol2(s.id, seed), s.normal);
    if (dot(direction, geometricNormal) <= 0.0) return kNoRay;
    return Ray(s.position, 0.0, direction, 1.0e30);
}

#endif
