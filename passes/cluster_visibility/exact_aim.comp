#version 460
#extension GL_GOOGLE_include_directive : require
// Rays from faces through the scene itself. A thread takes a ray.
#include "passes/cluster_visibility/face_ray.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

layout(scalar) writeonly buffer Rays { Ray data[]; } rays;

void main() {
    const uint ray = linearIndex();
    if (ray >= push.rays) return;
    vec3 origin, direction, normal;
    faceRay(ray, origin, direction, normal);
    rays.data[ray] = Ray(origin, 0.0, direction, 1.0e30);
}
