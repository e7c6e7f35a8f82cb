// A ray from each hit that tests whether the surface there is occluded, as place_surfels tests surfels.
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/scene.glsl"
#include "passes/surfels/occlusion_ray.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Rays { Ray data[]; } rays;
layout(scalar) readonly buffer Hits { Hit data[]; } hits;
layout(scalar) writeonly buffer OcclusionRays { Ray data[]; } occlusionRays;
layout(push_constant) uniform Push {
    uint rayCount;
    float voxelSize;  // m
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.rayCount) return;
    occlusionRays.data[i] = kNoRay;
    if (hits.data[i].triangle == NO_HIT) return;
    const SurfacePoint p = surfacePoint(hits.data[i].triangle, vec2(hits.data[i].u, hits.data[i].v));
    const vec3 n = dot(p.geometricNormal, rays.data[i].direction) <= 0.0 ? p.geometricNormal : -p.geometricNormal;
    occlusionRays.data[i] = occlusionRay(p.position + p.offset * n, n, push.voxelSize);
}
