// Lists the links of a batch that have to be traced again, with their rays: those that begin or end close to a changed
// box, where surfels may have changed, and those that cross one up to their hit.
#include "passes/common/compute/changed_boxes.glsl"
#include "passes/surfels/path_ray.glsl"
#include "shaders/compute/large_buffer.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Surfels { Surfel data[]; } surfels;
layout(scalar) readonly buffer LinksRef { LargeUints links; };
layout(scalar) readonly buffer HitDistancesRef { LargeFloats hitDistances; };  // m
layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
layout(scalar) writeonly buffer ListedRays { uint data[]; } listedRays;
buffer ListedCount { uint value; } listedCount;
layout(push_constant) uniform Push {
    uint firstInChunk;
    uint firstSurfel;
    uint batchSurfels;
    uint raysPerSurfel;
    uint surfelCount;
    uint seed;
    float reach;  // m; how far from a change the surfel of a hit may be another one.
} push;

bool isNearChange(vec3 point) {
    const vec3 reach = vec3(push.reach);
    for (uint i = 1u; i < boxes.data.length(); ++i)
        if (all(greaterThan(point, boxes.data[i].low - reach)) && all(lessThan(point, boxes.data[i].high + reach))) return true;
    return false;
}

Box boundsInReach() { return Box(boxes.data[0].low - push.reach, boxes.data[0].high + push.reach); }

// Whether a box lies behind the surfel, where none of its rays go.
bool isBehind(Box box, Surfel s) {
    const vec3 center = 0.5 * (box.low + box.high) - s.position, halfSize = 0.5 * (box.high - box.low);
    return dot(center, s.normal) + dot(halfSize, abs(s.normal)) < 0.0;
}

bool hasChanged(Ray ray, Box bounds) {
    if (!intersects(ray, bounds)) return false;
    return isNearChange(ray.origin) || isNearChange(ray.origin + ray.tMax * ray.direction) || intersectsChangedBox(ray);
}

void main() {
    const uint i = linearIndex();
    if (i >= push.batchSurfels) return;
    const Surfel s = surfels.data[push.firstInChunk + i];
    const bool exists = s.id != VOXRAY_NO_SURFEL;
    const Box bounds = boundsInReach();
    if (exists && isBehind(bounds, s)) return;
    const uint seed = hashCombine(push.seed, s.id);
    for (uint ray = 0u; ray < push.raysPerSurfel; ++ray) {
        const uint link = ray * push.surfelCount + push.firstSurfel + i;
        if (!exists) {
            links.data[link] = 0xffffffffu;
            hitDistances.data[link] = 1.0e30;
            continue;
        }
        const vec3 direction = cosineDirection(sobol2(ray, seed), s.normal);
        if (!hasChanged(Ray(s.position, 0.0, direction, hitDistances.data[link]), bounds)) continue;
        const uint listed = atomicAdd(listedCount.value, 1u);
        rays.data[listed] = Ray(s.position, 0.0, direction, 1.0e30);
        listedRays.data[listed] = i * push.raysPerSurfel + ray;
    }
}
