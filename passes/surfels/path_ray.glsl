// The next ray of a path from a surfel.
#ifndef VOXRAY_PATH_RAY_GLSL
#define VOXRAY_PATH_RAY_GLSL

#include "shaders/scene/sampling.glsl"
#include "passes/surfels/surfel_types.h"
#include "shaders/trace/ray_types.h"

// Cosine-distributed about the surfel's normal; inactive where the direction is below the surface. `geometricNormal`:
// unit length, on the surfel's side.
Ray pathRay(Surfel s, vec3 geometricNormal, uint seed) {
    const vec3 direction = cosineDirection(sobol2(s.id, seed), s.normal);
    if (dot(direction, geometricNormal) <= 0.0) return kNoRay;
    return Ray(s.position, 0.0, direction, 1.0e30);
}

#endif
