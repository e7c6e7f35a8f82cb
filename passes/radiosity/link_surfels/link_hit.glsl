// The hit of a link's ray in 32 bits, which tells whether a change may affect the link (list_changed_links.comp).
#ifndef VOXRAY_LINK_HIT_GLSL
#define VOXRAY_LINK_HIT_GLSL

#include "passes/surfels/surfel_types.h"
#include "shaders/scene/octahedral.glsl"

const float NO_LINK_HIT = 65504.0;  // Voxels; the largest half float.

// Bounds of the errors of packing: of the direction, in radians, and of the distance, relative to it.
const float LINK_DIRECTION_ERROR = 0.017;
const float LINK_DISTANCE_ERROR = 1.0 / 512.0;

// Hits are stored in blocks of surfels, ray by ray: a test of all rays of a group of surfels then reads them in order.
const uint LINK_HIT_BLOCK = 16u;  // kHitBlock of link_surfels.cpp.

uint linkHitIndex(uint surfel, uint ray, uint raysPerSurfel) {
    return (surfel / LINK_HIT_BLOCK * raysPerSurfel + ray) * LINK_HIT_BLOCK + surfel % LINK_HIT_BLOCK;
}

// `voxels`: distance of the hit; rounded up. `direction`: unit length; 8 bits for each coordinate of the octahedral map.
uint packLinkHit(vec3 direction, float voxels) {
    const uint distance_ = packHalf2x16(vec2(min(voxels * (1.0 + 0.5 * LINK_DISTANCE_ERROR), NO_LINK_HIT), 0.0));
    const ivec2 steps = ivec2(round(octahedralPoint(direction) * 127.0));
    return distance_ | (uint(steps.x) & 255u) << 16 | (uint(steps.y) & 255u) << 24;
}

float linkHitDistance(uint bits) { return unpackHalf2x16(bits & 0xffffu).x; }

// The half float's bits, which are in the same order.
uint linkHitDistanceBits(uint bits) { return bits & 0xffffu; }

// Not of unit length, which takes no square root.
vec3 scaledLinkHitDirection(uint bits) {
    const vec2 on = vec2(bitfieldExtract(int(bits), 16, 8), bitfieldExtract(int(bits), 24, 8));
    const float z = 127.0 - abs(on.x) - abs(on.y);
    return vec3(z >= 0.0 ? on : (127.0 - abs(on.yx)) * signs(on), z);
}

vec3 linkHitDirection(uint bits) { return normalize(scaledLinkHitDirection(bits)); }

// In voxels. Lower bound of distances in their mean inverse, since in a corner one ray would dominate it. Chosen.
const float MIN_LINK_DISTANCE = 1.0 / 64.0;

// Units of inverse distances in fixed point, whose sum over rays has 31 bits: sums do not depend on their order.
float inverseDistanceUnits(uint raysPerSurfel) { return 2147483648.0 * MIN_LINK_DISTANCE / float(raysPerSurfel); }

// 1/voxel in units; 0 where nothing was hit.
uint linkInverseDistance(uint bits, float units) {
    const float distance_ = linkHitDistance(bits);
    precise const float inverse = units / max(distance_, MIN_LINK_DISTANCE);
    return distance_ < NO_LINK_HIT ? uint(inverse) : 0u;
}

#endif
