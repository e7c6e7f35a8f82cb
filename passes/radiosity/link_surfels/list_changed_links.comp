// Lists the links of a batch that have to be traced again, with their rays: those that begin or end close to a changed
// box, where surfels may have changed, and those that cross one up to their hit.
#include "passes/common/compute/changed_boxes.glsl"
#include "passes/radiosity/link_surfels/link_hit.glsl"
#include "passes/surfels/path_ray.glsl"
#include "shaders/compute/large_buffer.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Surfels { Surfel data[]; } surfels;
layout(scalar) readonly buffer LinksRef { LargeUints links; };
layout(scalar) readonly buffer LinkHitsRef { LargeUints linkHits; };
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
    float reach;      // m; how far from a change the surfel of a hit may be another one.
    float voxelSize;  // m
} push;

Box widened(Box box, float margin) { return Box(box.low - margin, box.high + margin); }

bool contains(Box box, vec3 point) {
    return all(greaterThan(point, box.low)) && all(lessThan(point, box.high));
}

bool isNearChange(vec3 point, float reach) {
    for (uint i = 1u; i < boxes.data.length(); ++i)
        if (contains(widened(boxes.data[i], reach), point)) return true;
    return false;
}

// `ray`: up to its hit, whose distance is rounded up.
bool hasChanged(Ray ray) {
    return isNearChange(ray.origin, push.reach) || intersectsChangedBox(ray) ||
           isNearChange(ray.origin + ray.tMax * ray.direction, push.reach + LINK_DISTANCE_ERROR * ray.tMax);
}

// Whether a box lies behind the surfel, where none of its rays go.
bool isBehind(Box box, Surfel s) {
    const vec3 center = 0.5 * (box.low + box.high) - s.position, halfSize = 0.5 * (box.high - box.low);
    return dot(center, s.normal) + dot(halfSize, abs(s.normal)) < 0.0;
}

// A box that contains what a ray of the surfel that is known up to the errors of packing may meet of another one.
Box widenedByErrors(Box box, vec3 origin) {
    const float farthest = distance(origin, 0.5 * (box.low + box.high)) + 0.5 * distance(box.low, box.high);
    return widened(box, (LINK_DIRECTION_ERROR + LINK_DISTANCE_ERROR) * farthest);
}

void main() {
    const uint i = linearIndex();
    if (i >= push.batchSurfels) return;
    const Surfel s = surfels.data[push.firstInChunk + i];
    const bool exists = s.id != VOXRAY_NO_SURFEL;
    const Box bounds = widenedByErrors(widened(boxes.data[0], push.reach), s.position);
    if (exists && isBehind(bounds, s)) return;
    const uint seed = hashCombine(push.seed, s.id);
    for (uint ray = 0u; ray < push.raysPerSurfel; ++ray) {
        const uint link = ray * push.surfelCount + push.firstSurfel + i;
        if (!exists) {
            links.data[link] = 0xffffffffu;
            linkHits.data[link] = packLinkHit(vec3(0.0, 0.0, 1.0), NO_LINK_HIT);
            continue;
        }
        // Most rays are far from all changes, which their packed directions tell in less time than it takes to find them
        const uint hit = linkHits.data[link];
        const float voxels = linkHitDistance(hit), tMax = voxels < NO_LINK_HIT ? voxels * push.voxelSize : 1.0e30;
        if (!intersects(Ray(s.position, 0.0, linkHitDirection(hit), tMax), bounds)) continue;
        const vec3 direction = cosineDirection(sobol2(ray, seed), s.normal);
        if (!hasChanged(Ray(s.position, 0.0, direction, tMax))) continue;
        const uint listed = atomicAdd(listedCount.value, 1u);
        rays.data[listed] = Ray(s.position, 0.0, direction, 1.0e30);
        listedRays.data[listed] = i * push.raysPerSurfel + ray;
    }
}
