#version 460
#extension GL_GOOGLE_include_directive : require
// Rays from the surfels of patches through the scene. A thread takes a ray.
#include "passes/cluster_visibility/face_ray.glsl"
#include "shaders/scene/surface_offset.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

layout(scalar) writeonly buffer Rays { Ray data[]; } rays;

void main() {
    const uint ray = linearIndex();
    if (ray >= push.rays) return;
    const PatchSurfel s = raySurfel(ray);
    const vec3 direction = rayDirection(ray, s);
    // About a face's axis a ray may lead below the surface.
    rays.data[ray] = dot(direction, s.normal) > 0.0
                         ? Ray(s.position + surfaceOffset(s.position) * s.normal, 0.0, direction, 1.0e30)
                         : kNoRay;
}
