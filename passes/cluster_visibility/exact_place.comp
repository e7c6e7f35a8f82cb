#version 460
#extension GL_GOOGLE_include_directive : require
// Rays that find the surfaces before a face: from the face into its voxel, along the axis. A thread takes a ray.
#include "passes/cluster_visibility/face_ray.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

layout(scalar) writeonly buffer Rays { Ray data[]; } rays;

void main() {
    const uint ray = linearIndex();
    if (ray >= push.rays) return;
    const uint face = rayFace(ray);
    const vec3 axis = faceNormal(face % 6u);
    vec3 tangent, bitangent;
    frame(axis, tangent, bitangent);
    const vec2 place = sobol2(ray % push.raysPerFace, raySeed(ray, 1u)) - 0.5;
    const vec3 at = vec3(coordinates.data[face / 6u]) + 0.5 + 0.5 * axis + tangent * place.x + bitangent * place.y;
    rays.data[ray] = Ray(push.grid.origin + push.grid.voxelSize * at, 0.0, -axis, push.grid.voxelSize);
}
