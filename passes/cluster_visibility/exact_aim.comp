#version 460
#extension GL_GOOGLE_include_directive : require
// Rays from the surfaces before faces through the scene itself. A thread takes a ray.
#include "passes/cluster_visibility/face_ray.glsl"
#include "shaders/scene/scene.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
layout(scalar) readonly buffer Hits { Hit data[]; } hits;  // Of the rays that look for the surfaces.

void main() {
    const uint ray = linearIndex();
    if (ray >= push.rays) return;
    vec3 origin, direction, normal;
    faceRay(ray, origin, direction, normal);
    const uint index = ray % push.raysPerFace, first = ray - index;
    const vec3 axis = faceNormal(rayFace(ray) % 6u);
    // The ray's own point, or the next one that the face has.
    for (uint k = 0u; k < push.raysPerFace; ++k) {
        const Hit hit = hits.data[first + (index + k) % push.raysPerFace];
        if (hit.triangle == NO_HIT) continue;
        const SurfacePoint s = surfacePoint(hit.triangle, vec2(hit.u, hit.v));
        const vec3 n = dot(s.geometricNormal, axis) < 0.0 ? -s.geometricNormal : s.geometricNormal;
        if (dot(n, axis) < 0.1) continue;
        origin = s.position + 1e-3 * push.grid.voxelSize * n;
        direction = cosineDirection(sobol2(index, raySeed(ray, 0u)), push.alongAxis == 1u ? axis : n);
        break;
    }
    rays.data[ray] = Ray(origin, 0.0, direction, 1.0e30);
}
