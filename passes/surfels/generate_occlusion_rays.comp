// A ray from each hit that tests whether the surface is occluded, on the side that the hit's ray came from.
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/scene.glsl"
#include "passes/surfels/occlusion_ray.glsl"
#ifdef VOXEL_LEVELS
#include "shaders/voxels/voxel_levels.glsl"
#endif
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Rays { Ray data[]; } rays;
layout(scalar) readonly buffer Hits { Hit data[]; } hits;
layout(scalar) writeonly buffer OcclusionRays { Ray data[]; } occlusionRays;
layout(push_constant) uniform Push {
    uint rayCount;
#ifndef VOXEL_LEVELS
    float voxelSize;  // m
#endif
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.rayCount) return;
    occlusionRays.data[i] = kNoRay;
    const Ray ray = rays.data[i];
    const Hit hit = hits.data[i];
    if (ray.tMax < ray.tMin || hit.triangle == NO_HIT) return;
    const SurfacePoint p = surfacePoint(hit.triangle, vec2(hit.u, hit.v));
    if (dot(p.geometricNormal, p.geometricNormal) == 0.0) return;
    const vec3 normal = dot(p.geometricNormal, ray.direction) <= 0.0 ? p.geometricNormal : -p.geometricNormal;
#ifdef VOXEL_LEVELS
    const float voxelSize = gridAt(p.position).voxelSize;
#else
    const float voxelSize = push.voxelSize;
#endif
    occlusionRays.data[i] = occlusionRay(p.position + normal * p.offset, normal, voxelSize);
}
