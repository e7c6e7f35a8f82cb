// For each hit a ray off the surface along its normal, as long as a voxel: what it meets hides the surface from open space.
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/sampling.glsl"
#include "shaders/scene/scene.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Rays { Ray data[]; } rays;
layout(scalar) readonly buffer Hits { Hit data[]; } hits;
layout(scalar) writeonly buffer VisibilityRays { Ray data[]; } visibilityRays;
layout(push_constant, scalar) uniform Push {
    uint batchRays;
    float voxelSize;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.batchRays) return;
    Ray probe;
    probe.origin = vec3(0.0);
    probe.direction = vec3(0.0, 0.0, 1.0);
    probe.tMin = 0.0;
    probe.tMax = -1.0;
    const Ray ray = rays.data[i];
    const Hit hit = hits.data[i];
    if (ray.tMax >= ray.tMin && hit.triangle != NO_HIT) {
        const SurfacePoint s = surfacePoint(hit.triangle, vec2(hit.u, hit.v));
        if (dot(s.geometricNormal, s.geometricNormal) > 0.0) {
            const vec3 normal = dot(s.geometricNormal, ray.direction) <= 0.0 ? s.geometricNormal : -s.geometricNormal;
            probe.origin = s.position + normal * s.offset;
            probe.direction = normal;
            probe.tMax = push.voxelSize;
        }
    }
    visibilityRays.data[i] = probe;
}
