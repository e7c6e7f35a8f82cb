// What lookups read of a surfel, in 64 bits, since their cost is that of reading surfels.
#ifndef VOXRAY_PACKED_SURFEL_GLSL
#define VOXRAY_PACKED_SURFEL_GLSL

#include "shaders/scene/octahedral.glsl"

// x: position in the surfel's voxel, 10 bits per axis, and whether the surfel is occluded; y: octahedral normal in 24
// bits, and mean inverse distance in the highest 8. A vector is one load for software Vulkan, a struct would be two.
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer PackedSurfels { uvec2 data[]; };

// The same, and z: irradiance by packRadiosity().
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer LitSurfels { uvec3 data[]; };

// A surfel on the border of two voxels may belong to the other one: positions range from one voxel before its own to
// one behind it.
const float STEPS_PER_VOXEL = 1024.0 / 3.0;

uint packNormal(vec3 normal) {
    const uint bits = toOctahedral(normal);
    // Two signed numbers of 16 bits each, rounded to 12
    const ivec2 rounded = min(ivec2(bitfieldExtract(int(bits), 0, 16), int(bits) >> 16) + 8, ivec2(32767)) >> 4;
    return (uint(rounded.x) & 0xfffu) | (uint(rounded.y) & 0xfffu) << 12;
}

// `inVoxel`: voxels from the voxel's corner, -1 to 2. Rounded to the center of a step.
uvec2 packSurfel(vec3 inVoxel, vec3 normal, bool isOccluded) {
    const uvec3 steps = uvec3(clamp((inVoxel + 1.0) * STEPS_PER_VOXEL, vec3(0.0), vec3(1023.0)));
    return uvec2(steps.x | steps.y << 10 | steps.z << 20 | uint(isOccluded) << 30, packNormal(normal));
}

vec3 unpackPosition(uint x) {
    return (vec3(x & 1023u, x >> 10 & 1023u, x >> 20 & 1023u) + 0.5) / STEPS_PER_VOXEL - 1.0;
}

bool isOccludedSurfel(uint x) { return (x >> 30) != 0u; }

vec3 unpackNormal(uint y) { return fromOctahedral((y & 0xfffu) << 4 | (y & 0xfff000u) << 8); }

// Mean of 1 / distance to what the surfel sees, 1/voxel; 0 where it sees the sky alone. 20 steps per power of two from
// 1/64 on, so that it is rounded by 2 % at most.
const float STEPS_PER_OCTAVE = 20.0, MIN_INVERSE_DISTANCE = 1.0 / 64.0;

uint packInverseDistance(uint y, float inverseDistance) {
    const float step_ = round(STEPS_PER_OCTAVE * log2(inverseDistance / MIN_INVERSE_DISTANCE)) + 1.0;
    const uint steps = inverseDistance > 0.0 ? uint(clamp(step_, 0.0, 255.0)) : 0u;
    return (y & 0xffffffu) | steps << 24;
}

float unpackInverseDistance(uint y) {
    const uint steps = y >> 24;
    return steps == 0u ? 0.0 : MIN_INVERSE_DISTANCE * exp2((float(steps) - 1.0) / STEPS_PER_OCTAVE);
}

#endif
