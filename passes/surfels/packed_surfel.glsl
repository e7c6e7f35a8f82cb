// What lookups need of a surfel, in few bits.
#ifndef VOXRAY_PACKED_SURFEL_GLSL
#define VOXRAY_PACKED_SURFEL_GLSL

#include "shaders/scene/octahedral.glsl"

// What is known before the light. x: position in the surfel's voxel, 10 bits per axis, and whether the surfel is occluded;
// y: octahedral normal in 24 bits, and mean inverse distance in the highest 8.
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer PackedSurfels { uvec2 data[]; };

// A surfel on the border of two voxels may belong to the other one: positions range from one voxel before its own to
// one behind it.
const float STEPS_PER_VOXEL = 1024.0 / 3.0, VOXELS_PER_STEP = 3.0 / 1024.0;

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

// From `origin`, in voxels from the voxel's corner.
vec3 unpackPosition(uint x, vec3 origin) {
    const vec3 steps = vec3(x & 1023u, x >> 10 & 1023u, x >> 20 & 1023u);
    return steps * VOXELS_PER_STEP + (0.5 * VOXELS_PER_STEP - 1.0 - origin);
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

// A surfel with its light, in two words of 64 bits, of which software Vulkan reads eight at once: position and whether it is
// occluded as above, and irradiance by packRadiosity(); the normal by 16 bits a coordinate, and the high bits of the mean
// inverse distance as a float, which need less work to unpack.
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer LitSurfels { u64vec2 data[]; };

struct LitSurfel {
    uint position;  // unpackPosition(), isOccludedSurfel()
    uint radiosity;
    vec3 normal;
    float inverseDistance;  // Mean, 1/voxel.
};

u64vec2 packLit(uvec2 surfel, uint radiosity) {
    const vec3 n = unpackNormal(surfel.y);
    const uint distanceBits = (floatBitsToUint(unpackInverseDistance(surfel.y)) + 0x8000u) & 0xffff0000u;
    const uvec2 words = uvec2(packSnorm2x16(n.xy), (packSnorm2x16(vec2(n.z, 0.0)) & 0xffffu) | distanceBits);
    return u64vec2(packUint2x32(uvec2(surfel.x, radiosity)), packUint2x32(words));
}

LitSurfel unpackLit(u64vec2 words) {
    const uvec2 a = unpackUint2x32(words.x), b = unpackUint2x32(words.y);
    const vec3 n = vec3(ivec3(b.x << 16, b.x, b.y << 16) >> 16) * (1.0 / 32767.0);
    return LitSurfel(a.x, a.y, n, uintBitsToFloat(b.y & 0xffff0000u));
}

#endif
