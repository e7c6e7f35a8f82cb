// The bounded geometry term between a surface and a virtual point light, and the shadow ray between them.
#ifndef VOXRAY_VPL_GEOMETRY_TERM_GLSL
#define VOXRAY_VPL_GEOMETRY_TERM_GLSL

#include "shaders/scene/sampling.glsl"
#include "shaders/scene/surface_offset.glsl"
#include "shaders/trace/ray_types.h"
#include "passes/vpls/vpl_types.h"

// The bounded geometry term over pi, 1/m²: unoccluded irradiance over flux. A Lambert surface has the radiant intensity
// flux * cos / pi, and max(d², bound) stands for d². `normal`: shading normal, `faceNormal`: geometric normal, unit
// length, on one side. `minDistanceSquared`: the bound, m². `direction`: to the light, unit length.
float vplGeometryTerm(Vpl vpl, vec3 position, vec3 normal, vec3 faceNormal, float minDistanceSquared,
                      out vec3 direction) {
    const vec3 toVpl = vpl.position - position;
    const float distanceSquared = dot(toVpl, toVpl);
    direction = toVpl * inversesqrt(max(distanceSquared, 1e-30));
    const float cosReceiver = dot(normal, direction), cosVpl = -dot(vpl.normal, direction);
    const bool isAboveFace = dot(faceNormal, direction) > 0.0;
    if (cosReceiver <= 0.0 || cosVpl <= 0.0 || !isAboveFace || distanceSquared == 0.0) return 0.0;
    return cosReceiver * cosVpl / (PI * max(distanceSquared, minDistanceSquared));
}

// Shadow ray to a virtual light from `position`, which is off the surface. `direction`: of vplGeometryTerm(). Inactive
// where the light is too near for an occluder.
Ray vplRay(Vpl vpl, vec3 position, vec3 direction) {
    const float length_ = shadowRayLength(distance(vpl.position, position), pointOffset(vpl.position), position);
    return Ray(position, 0.0, direction, length_);
}

#endif
