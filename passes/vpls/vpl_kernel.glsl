// How much of a virtual point light's flux arrives, and the ray that tells whether anything is in the way.
#ifndef VOXRAY_VPL_KERNEL_GLSL
#define VOXRAY_VPL_KERNEL_GLSL

#include "shaders/scene/sampling.glsl"
#include "shaders/scene/surface_offset.glsl"
#include "shaders/trace/ray_types.h"
#include "passes/vpls/vpl_types.h"

// Irradiance over flux, 1/m², of a surface with shading normal `normal` and geometric normal `faceNormal` (unit, on one side), if
// nothing is in the way: cosines over pi times the squared distance, or the bound (m²) where that is more. A Lambert surface's
// radiant intensity is its flux times the cosine over pi. `direction`: to the light, unit length.
float vplKernel(Vpl vpl, vec3 position, vec3 normal, vec3 faceNormal, float minDistanceSquared, out vec3 direction) {
    const vec3 way = vpl.position - position;
    const float squared = dot(way, way);
    direction = way * inversesqrt(max(squared, 1e-30));
    const float cosine = dot(normal, direction), vplCosine = -dot(vpl.normal, direction);
    const bool isAbove = dot(faceNormal, direction) > 0.0 && dot(vpl.faceNormal, direction) < 0.0;
    if (cosine <= 0.0 || vplCosine <= 0.0 || !isAbove || squared == 0.0) return 0.0;
    return cosine * vplCosine / (PI * max(squared, minDistanceSquared));
}

// From a point off a surface to a virtual light, in the unit direction that vplKernel() finds. None where it is so near that nothing
// can be in the way.
Ray vplRay(Vpl vpl, vec3 position, vec3 direction) {
    return Ray(position, 0.0, direction, reachOf(distance(vpl.position, position), pointOffset(vpl.position), position));
}

#endif
