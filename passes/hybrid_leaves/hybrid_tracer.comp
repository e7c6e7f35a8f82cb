// A stream of rays through hybrid leaves.
#include "shaders/compute/linear_index.glsl"
#include "passes/hybrid_leaves/hybrid_traversal.glsl"
layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kOccluded = false;

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer RayStream { Ray data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer StartStream { RayStart data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer HitStream { Hit data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer WordStream { uint data[]; };
layout(scalar) buffer HybridTestCounts { uint words[2]; } hybridTestCounts;  // 64 bits, the low word first.
layout(push_constant, scalar) uniform Push {
    uint64_t rays;
    uint64_t starts;  // 0: rays without surface and width.
    uint64_t hits;    // Hit each, or a word where kOccluded.
    VoxelGrid grid;
    float maxWidth;  // m: wider rays end (HIT_IS_WIDE).
    uint firstRay;
    uint endRay;
} push;

// Inactive and non-finite rays miss.
bool isTraceable(Ray ray) {
    const bool isFinite = all(lessThanEqual(abs(ray.origin), vec3(1.8e18))) && all(lessThanEqual(abs(ray.direction), vec3(1.8e18)));
    return isFinite && any(notEqual(ray.direction, vec3(0.0))) && ray.tMin >= 0.0 && ray.tMax >= ray.tMin;
}

void main() {
    const uint i = push.firstRay + linearIndex();
    if (i >= push.endRay) return;
    const Ray ray = RayStream(push.rays).data[i];
    RayStart start = RayStart(vec3(0.0), 0.0, 0.0);
    if (push.starts != 0ul) start = StartStream(push.starts).data[i];
    Hit hit = Hit(ray.tMax, NO_HIT, 0.0, 0.0);
    if (isTraceable(ray)) hit = hybridClosestHit(push.grid, ray.origin, ray.direction, ray.tMin, ray.tMax, start, push.maxWidth);
    if (kOccluded) {
        WordStream(push.hits).data[i] = hit.triangle == NO_HIT ? 0u : 1u;
    } else {
        HitStream(push.hits).data[i] = hit;
    }
    countMarch();
    if (hybridTests != 0u) {
        const uint lowWord = atomicAdd(hybridTestCounts.words[0], hybridTests);
        if (lowWord + hybridTests < lowWord) atomicAdd(hybridTestCounts.words[1], 1u);
    }
}
