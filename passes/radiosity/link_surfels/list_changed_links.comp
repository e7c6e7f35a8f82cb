// Lists the links of a batch that have to be traced again, with their rays, or marks them (WAIT): those that begin or end close to a changed
// box, where surfels may have changed, and those that cross one up to their hit. Links are told apart in steps, of which
// each takes more time than the one before and is left fewer links. Each is a loop over what is left, which ends as soon
// as no surfel of a group has more.
#include "passes/common/compute/changed_boxes.glsl"
#include "passes/radiosity/link_surfels/link_hit.glsl"
#include "passes/radiosity/link_surfels/waiting_links.glsl"
#include "passes/surfels/path_ray.glsl"
#include "shaders/compute/large_buffer.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Surfels { Surfel data[]; } surfels;
layout(scalar) readonly buffer LinksRef { LargeUints links; };
layout(scalar) readonly buffer LinkHitsRef { LargeUints linkHits; };
layout(scalar) readonly buffer InverseSumsRef { LargeUints inverseSums; };  // By surfel (mean_inverse_distance.comp).
#ifndef WAIT
layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
layout(scalar) writeonly buffer ListedRays { uint data[]; } listedRays;
buffer ListedCount { uint value; } listedCount;
#endif
layout(push_constant) uniform Push {
    uint firstInChunk;
    uint firstSurfel;
    uint batchSurfels;
    uint raysPerSurfel;
    uint surfelCount;
    uint seed;
    float reach;      // m; how far from a change the surfel of a hit may be another one.
    float voxelSize;  // m
#ifdef WAIT
    uint wordsPerSurfel;
#endif
} push;

// `ray`: up to its hit, whose distance is rounded up.
bool hasChanged(Ray ray) {
    return intersectsChangedBox(ray) ||
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

// The directions from a surfel to the sphere around a box, and how far away it is.
struct Cone {
    float squaredCosine;  // Times the squared distance of the center; not positive where the surfel is in the sphere.
    uint nearest, farthest;  // linkHitDistanceBits() of hits in the sphere, at least and at most.
};

uint distanceBits(float distance_) {
    return packHalf2x16(vec2(clamp(distance_ / push.voxelSize, 0.0, NO_LINK_HIT), 0.0));
}

Cone coneOf(Box box, vec3 origin) {
    const float radius = 0.5 * distance(box.low, box.high), distance_ = distance(0.5 * (box.low + box.high), origin);
    return Cone(distance_ * distance_ - radius * radius, distanceBits((1.0 - LINK_DISTANCE_ERROR) * (distance_ - radius)),
                distanceBits((1.0 + 2.0 * LINK_DISTANCE_ERROR) * (distance_ + radius)));
}

// `along`: of a direction and the axis, which is the center's offset. `squaredLength`: of the direction.
bool isInCone(Cone cone, float along, float squaredLength) {
    return (along > 0.0 && along * along >= cone.squaredCosine * squaredLength) || cone.squaredCosine <= 0.0;
}

// What the rays of a surfel may meet, up to the errors of packing.
struct Bounds {
    Box crossed;  // Changed surfaces, which a ray may cross.
    Box ended;    // These and what is within reach of them, where a ray may end.
    vec3 axis;    // To the center of both.
    Cone toCrossed, toEnded;
};

bool mayMeet(Bounds bounds, uint hit) {
    const vec3 direction = scaledLinkHitDirection(hit);
    const float along = dot(direction, bounds.axis), squaredLength = dot(direction, direction);
    const uint distance_ = linkHitDistanceBits(hit);
    const bool ends = distance_ <= bounds.toEnded.farthest && isInCone(bounds.toEnded, along, squaredLength);
    return distance_ >= bounds.toEnded.nearest && (ends || isInCone(bounds.toCrossed, along, squaredLength));
}

uint hitOf(uint surfel, uint ray) { return linkHits.data[linkHitIndex(surfel, ray, push.raysPerSurfel)]; }

float lengthOf(uint hit) {
    const float voxels = linkHitDistance(hit);
    return voxels < NO_LINK_HIT ? voxels * push.voxelSize : 1.0e30;
}

void list(uint inBatch, uint ray, vec3 origin, vec3 direction) {
#ifdef WAIT
    const uint word = (push.firstSurfel + inBatch) * push.wordsPerSurfel + ray / 32u;
    waiting.data[word] |= 1u << (ray & 31u);
#else
    const uint listed = atomicAdd(listedCount.value, 1u);
    rays.data[listed] = Ray(origin, 0.0, direction, 1.0e30);
    listedRays.data[listed] = inBatch * push.raysPerSurfel + ray;
#endif
}

// All links of a surfel close to a change.
void listAll(uint inBatch, Surfel s) {
    const uint surfel = push.firstSurfel + inBatch, seed = hashCombine(push.seed, s.id);
    for (uint ray = 0u; ray < push.raysPerSurfel; ++ray)
        list(inBatch, ray, s.position, cosineDirection(sobol2(ray, seed), s.normal));
}

void clearAll(uint surfel) {
    for (uint ray = 0u; ray < push.raysPerSurfel; ++ray) {
        links.data[ray * push.surfelCount + surfel] = LINK_NOT_TRACED;
        linkHits.data[linkHitIndex(surfel, ray, push.raysPerSurfel)] = packLinkHit(vec3(0.0, 0.0, 1.0), NO_LINK_HIT);
    }
    inverseSums.data[surfel] = 0u;
#ifdef WAIT
    for (uint word = 0u; word < push.wordsPerSurfel; ++word) waiting.data[surfel * push.wordsPerSurfel + word] = 0u;
#endif
}

// Of links [first, first + count) of a surfel, at most 32.
void listChanged(uint inBatch, Surfel s, Bounds bounds, uint first, uint count) {
    const uint surfel = push.firstSurfel + inBatch, seed = hashCombine(push.seed, s.id);
    uint inCone = 0u, inBounds = 0u;
    for (uint i = 0u; i < count; ++i) inCone |= uint(mayMeet(bounds, hitOf(surfel, first + i))) << i;
    while (inCone != 0u) {
        const uint i = takeBit(inCone), hit = hitOf(surfel, first + i);
        const Ray known = Ray(s.position, 0.0, linkHitDirection(hit), lengthOf(hit));
        const bool ends = contains(bounds.ended, known.origin + known.tMax * known.direction);
        inBounds |= uint(ends || intersects(known, bounds.crossed)) << i;
    }
    while (inBounds != 0u) {
        const uint ray = first + takeBit(inBounds);
        const vec3 direction = cosineDirection(sobol2(ray, seed), s.normal);
        if (hasChanged(Ray(s.position, 0.0, direction, lengthOf(hitOf(surfel, ray)))))
            list(inBatch, ray, s.position, direction);
    }
}

const uint SURFEL_GROUP = 128u;

// Surfels in an order in which those of one side of a surface follow each other: often a change lies behind them all.
uint surfelOf(uint invocation) {
    const uint inGroup = invocation % SURFEL_GROUP, side = inGroup / (SURFEL_GROUP / 2u);
    return invocation - inGroup + 2u * (inGroup % (SURFEL_GROUP / 2u)) + side;
}

void main() {
    const uint i = surfelOf(linearIndex());
    if (i >= push.batchSurfels) return;
    const Surfel s = surfels.data[push.firstInChunk + i];
    const bool exists = s.id != VOXRAY_NO_SURFEL;
    if (isNearChange(s.position, push.reach)) {
        if (exists)
            listAll(i, s);
        else
            clearAll(push.firstSurfel + i);
        return;
    }
    const Box crossed = widenedByErrors(boxes.data[0], s.position);
    const Box ended = widenedByErrors(widened(boxes.data[0], push.reach), s.position);
    if (!exists || isBehind(ended, s)) return;
    const vec3 axis = 0.5 * (crossed.low + crossed.high) - s.position;
    const Bounds bounds = Bounds(crossed, ended, axis, coneOf(crossed, s.position), coneOf(ended, s.position));
    for (uint first = 0u; first < push.raysPerSurfel; first += 32u)
        listChanged(i, s, bounds, first, min(push.raysPerSurfel - first, 32u));
}
