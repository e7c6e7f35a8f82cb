#version 460
#extension GL_GOOGLE_include_directive : require
// What rays through the scene see of the voxels: the face of the voxel at the hit, by the triangle's normal. A thread takes a ray.
#include "passes/cluster_visibility/face_ray.glsl"
#include "shaders/scene/scene.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Rays { Ray data[]; } rays;
layout(scalar) readonly buffer Hits { Hit data[]; } hits;
layout(scalar) writeonly buffer Targets { uint data[]; } targets;
buffer Missed { uint count; } missed;

uint seenBy(uint ray) {
    const Hit hit = hits.data[ray];
    if (hit.triangle == NO_HIT) {
        atomicAdd(missed.count, 1u);
        return NO_TARGET;
    }
    const SurfacePoint s = surfacePoint(hit.triangle, vec2(hit.u, hit.v));
    const uint voxel = nearestVoxel(push.grid, s.position);
    if (voxel == NO_VOXEL) return NO_TARGET;
    const vec3 normal = dot(s.geometricNormal, rays.data[ray].direction) > 0.0 ? -s.geometricNormal : s.geometricNormal;
    const VoxelMaterial m = voxelMaterial(voxel);
    const vec3 part = normal * normal;
    const float at = rayPick(ray);
    const uint axis = at < part.x ? 0u : at < part.x + part.y ? 1u : 2u;
    uint target;
    return seesVoxel(ray, voxel, faceOf(normal, axis), hit.t / push.grid.voxelSize, target) ? target : NO_TARGET;
}

void main() {
    const uint ray = linearIndex();
    if (ray < push.rays) targets.data[ray] = seenBy(ray);
}
