// Traces a stream of rays through hybrid leaves, one invocation per ray.
#include "shaders/compute/linear_index.glsl"
#include "passes/hybrid_leaves/hybrid_traversal.glsl"
#include "shaders/trace/ray_streams.glsl"
layout(local_size_x = 64) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer StartStream { RayStart data[]; };
layout(scalar) buffer HybridTestCounts { uint words[2]; } hybridTestCounts;  // 64 bits, the low word first.
layout(push_constant, scalar) uniform Push {
    uint64_t rays;
    uint64_t starts;  // 0: rays without surface and width.
    uint64_t results;
    VoxelGrid grid;
    float maxWidth;  // m: wider rays end (HIT_IS_WIDE).
    uint firstRay;
    uint endRay;
} push;

void main() {
    const uint i = push.firstRay + linearIndex();
    if (i >= push.endRay) return;
    const Ray ray = RayStream(push.rays).data[i];
    RayStart start = RayStart(vec3(0.0), 0.0, 0.0);
    if (push.starts != 0ul) start = StartStream(push.starts).data[i];
    Hit hit = Hit(ray.tMax, NO_HIT, 0.0, 0.0);
    if (isTraceable(ray))
        hit = hybridClosestHit(push.grid, ray.origin, ray.direction, ray.tMin, ray.tMax, start, push.maxWidth);
    storeResult(push.results, i, hit);
    countMarch();
    if (hybridTests != 0u) {
        const uint lowWord = atomicAdd(hybridTestCounts.words[0], hybridTests);
        if (lowWord + hybridTests < lowWord) atomicAdd(hybridTestCounts.words[1], 1u);
    }
}
