// Streams of rays and their results, by address: they may exceed maxStorageBufferRange.
#ifndef VOXRAY_RAY_STREAMS_GLSL
#define VOXRAY_RAY_STREAMS_GLSL

#include "shaders/trace/ray_types.h"

layout(constant_id = 0) const bool kOccluded = false;  // Results are uints, 1: occluded; else hits.

#define MAX_COORDINATE 1.8e18  // Embree's bound: rays with larger coordinates miss.

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer RayStream { Ray data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer HitStream { Hit data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer WordStream { uint data[]; };

// Whether a ray is active and finite; other rays miss.
bool isTraceable(Ray ray) {
    const bool isFinite_ = all(lessThanEqual(abs(ray.origin), vec3(MAX_COORDINATE))) &&
                           all(lessThanEqual(abs(ray.direction), vec3(MAX_COORDINATE)));
    return isFinite_ && any(notEqual(ray.direction, vec3(0.0))) && ray.tMin >= 0.0 && ray.tMax >= ray.tMin;
}

void storeResult(uint64_t results, uint ray, Hit hit) {
    if (kOccluded) WordStream(results).data[ray] = hit.triangle == NO_HIT ? 0u : 1u;
    else HitStream(results).data[ray] = hit;
}

#endif
