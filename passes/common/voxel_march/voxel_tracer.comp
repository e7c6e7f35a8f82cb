// A stream of rays through voxels.
#include "shaders/compute/linear_index.glsl"
#include "shaders/trace/ray_types.h"
#include "shaders/voxel_march/voxel_march.glsl"
layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kOccluded = false;

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer RayStream { Ray data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer HitStream { Hit data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer WordStream { uint data[]; };
layout(push_constant, scalar) uniform Push {
    RayStream rays;
    HitStream hits;  // Words, where rays are asked for occlusion.
    VoxelGrid grid;
    uint firstRay;
    uint endRay;
} push;

// Whether a ray is active and finite; others miss.
bool isTraceable(Ray ray) {
    const bool finite = all(lessThanEqual(abs(ray.origin), vec3(1.8e18))) && all(lessThanEqual(abs(ray.direction), vec3(1.8e18)));
    return finite && any(notEqual(ray.direction, vec3(0.0))) && ray.tMin >= 0.0 && ray.tMax >= ray.tMin;
}

void main() {
    const uint i = push.firstRay + linearIndex();
    if (i >= push.endRay) return;
    const Ray ray = push.rays.data[i];
    VoxelHit hit;
    const bool met = isTraceable(ray) && closest(push.grid, ray.origin, ray.direction, ray.tMin, ray.tMax, hit);
    if (kOccluded) {
        WordStream(push.hits).data[i] = met ? 1u : 0u;
    } else {
        push.hits.data[i] = met ? Hit(hit.t, voxelNumber(push.grid, hit.voxel), 0.0, 0.0) : Hit(ray.tMax, NO_HIT, 0.0, 0.0);
    }
    countMarch();
}
