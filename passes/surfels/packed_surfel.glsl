// What a lookup needs of a surfel, in 64 bits: reading them is what a lookup costs. Written by passes/radiosity/link_surfels/.
#ifndef VOXRAY_PACKED_SURFEL_GLSL
#define VOXRAY_PACKED_SURFEL_GLSL

#include "shaders/scene/octahedral.glsl"

// x: place in the surfel's voxel, 10 bits an axis, and whether the surfel is covered; y: normal, octahedral, in 24 bits, and mean inverse
// distance in the highest 8. A vector is one load for software Vulkan, a struct would be two.
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer PackedSurfels { uvec2 data[]; };

// The same and z: irradiance, as passes/surfels/radiosity.glsl packs it.
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer LitSurfels { uvec3 data[]; };

// A surfel that fell between two voxels belongs to a voxel next to its own: places reach one voxel out of it.
const float PLACE_STEPS = 1024.0 / 3.0;  // A voxel.

uint packNormal(vec3 normal) {
    const uint bits = toOctahedral(normal);
    // Signed numbers of 16 bits, rounded to 12.
    const ivec2 rounded = min(ivec2(bitfieldExtract(int(bits), 0, 16), int(bits) >> 16) + 8, ivec2(32767)) >> 4;
    return (uint(rounded.x) & 0xfffu) | (uint(rounded.y) & 0xfffu) << 12;
}

// inVoxel: from the voxel's corner, in voxels, -1 to 2. Rounds to the center of a step.
uvec2 packSurfel(vec3 inVoxel, vec3 normal, bool isCovered) {
    const uvec3 steps = uvec3(clamp((inVoxel + 1.0) * PLACE_STEPS, vec3(0.0), vec3(1023.0)));
    return uvec2(steps.x | steps.y << 10 | steps.z << 20 | uint(isCovered) << 30, packNormal(normal));
}

vec3 normalOfSurfel(uint bits) { return fromOctahedral((bits & 0xfffu) << 4 | (bits & 0xfff000u) << 8); }

// Mean of 1 / distance to what is seen from there, 1 / voxel; 0 where that is the sky alone. Twenty steps for each power of 2, from 1/64
// on: rounded by 2 % at most.
const float DISTANCE_STEPS = 20.0, MIN_INVERSE_DISTANCE = 1.0 / 64.0;

uint withInverseDistance(uint normal, float inverseDistance) {
    const float step_ = round(DISTANCE_STEPS * log2(inverseDistance / MIN_INVERSE_DISTANCE)) + 1.0;
    const uint steps = inverseDistance > 0.0 ? uint(clamp(step_, 0.0, 255.0)) : 0u;
    return (normal & 0xffffffu) | steps << 24;
}

float inverseDistanceOf(uint bits) {
    const uint steps = bits >> 24;
    return steps == 0u ? 0.0 : MIN_INVERSE_DISTANCE * exp2((float(steps) - 1.0) / DISTANCE_STEPS);
}

vec3 placeInVoxel(uint place) {
    return (vec3(place & 1023u, place >> 10 & 1023u, place >> 20 & 1023u) + 0.5) / PLACE_STEPS - 1.0;
}

bool isOccludedSurfel(uint place) { return (place >> 30) != 0u; }

#endif
