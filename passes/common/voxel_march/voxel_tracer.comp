// Traces a stream of rays through voxels, one invocation per ray.
#include "shaders/compute/linear_index.glsl"
#include "shaders/trace/ray_streams.glsl"
#include "shaders/voxel_march/voxel_march.glsl"
layout(local_size_x = 64) in;

layout(push_constant, scalar) uniform Push {
    uint64_t rays;
    uint64_t results;
    VoxelGrid grid;
    uint firstRay;
    uint endRay;
} push;

void main() {
    const uint i = push.firstRay + linearIndex();
    if (i >= push.endRay) return;
    const Ray ray = RayStream(push.rays).data[i];
    VoxelHit hit;
    const bool isHit = isTraceable(ray) && closest(push.grid, ray.origin, ray.direction, ray.tMin, ray.tMax, hit);
    storeResult(push.results, i,
                isHit ? Hit(hit.t, kOccluded ? 0u : voxelNumber(push.grid, hit.voxel), 0.0, 0.0)
                      : Hit(ray.tMax, NO_HIT, 0.0, 0.0));
    countMarch();
}
