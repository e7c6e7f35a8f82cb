// Irradiance samples merged by voxel face (host: passes/common/voxels/voxel_accumulator.h, which defines WRITE).
#ifndef VOXRAY_VOXEL_ACCUMULATOR_GLSL
#define VOXRAY_VOXEL_ACCUMULATOR_GLSL

#include "shaders/voxels/face.glsl"

#define WRITE_AVERAGE 0
#define WRITE_MAX 1
#define WRITE_MOVING_AVERAGE 2
#define WRITE_NONE 3

#if WRITE == WRITE_AVERAGE
#define WEIGHT_UNITS 16777216.0
#define LARGEST_SAMPLE 1099511627776.0  // 2^40 units: 2^16 times the typical irradiance.
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer VoxelSums { uint64_t data[]; };     // 3 per face
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer VoxelWeights { uint64_t data[]; };  // 1 per face
#elif WRITE == WRITE_MAX
// 3 per face, bits of floats
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer VoxelSums { uint data[]; };
// 1 for faces with samples
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer VoxelWeights { uint data[]; };
#elif WRITE == WRITE_MOVING_AVERAGE
// RGBA8, count in A
layout(buffer_reference, scalar, buffer_reference_align = 4) coherent buffer VoxelSums { uint data[]; };
#else
// By face; w: 1 for faces with samples
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer VoxelSums { vec4 data[]; };
#endif
layout(scalar) readonly buffer VoxelSumsRef { VoxelSums voxelSums; };
#if WRITE == WRITE_AVERAGE || WRITE == WRITE_MAX
layout(scalar) readonly buffer VoxelWeightsRef { VoxelWeights voxelWeights; };
#endif

// Modes without weights ignore samples of lower weights.
#define MIN_WEIGHT 0.0625

// Merges a sample into face voxel * 6 + direction (+x -x +y -y +z -z). `irradiance` in W/m², not negative;
// `weight` above 0; `scale` is VoxelAccumulator::scale().
void writeFace(uint face, vec3 irradiance, float weight, float scale) {
#if WRITE == WRITE_AVERAGE
    const vec3 units = min(irradiance * (weight * scale), LARGEST_SAMPLE);
    for (uint c = 0u; c < 3u; ++c)
        if (units[c] >= 0.5) atomicAdd(voxelSums.data[face * 3u + c], uint64_t(units[c] + 0.5));
    atomicAdd(voxelWeights.data[face], uint64_t(min(weight * WEIGHT_UNITS, LARGEST_SAMPLE) + 0.5));
#elif WRITE == WRITE_MAX
    // Nonnegative floats have the order of their bits
    if (weight < MIN_WEIGHT) return;
    for (uint c = 0u; c < 3u; ++c) atomicMax(voxelSums.data[face * 3u + c], floatBitsToUint(irradiance[c]));
    voxelWeights.data[face] = 1u;
#elif WRITE == WRITE_MOVING_AVERAGE
    // Magalhães 2020, listing 4.3: read, average, compare and swap
    if (weight < MIN_WEIGHT) return;
    const vec3 color = clamp(irradiance * scale, 0.0, 1.0);
    uint expected = 0u;
    uint desired = packUnorm4x8(vec4(color, 1.0 / 255.0));
    for (uint attempt = 0u; attempt < 65536u; ++attempt) {
        const uint found = atomicCompSwap(voxelSums.data[face], expected, desired);
        if (found == expected) return;
        expected = found;
        const vec4 mean = unpackUnorm4x8(found);
        const float count = round(mean.a * 255.0);
        desired = packUnorm4x8(vec4((mean.rgb * count + color) / (count + 1.0), (count + 1.0) / 255.0));
    }
#else
    if (weight >= MIN_WEIGHT) voxelSums.data[face] = vec4(irradiance, 1.0);
#endif
}

// Writes a sample of a surface's irradiance to the three faces that the surface faces, weighted by the squared
// components of its normal.
void writeIrradiance(uint voxel, vec3 normal, vec3 irradiance, float weight, float scale) {
    for (uint axis = 0u; axis < 3u; ++axis) {
        const float faceWeight = weight * normal[axis] * normal[axis];
        if (faceWeight > 0.0) writeFace(voxel * 6u + faceOf(normal, axis), irradiance, faceWeight, scale);
    }
}

// The merged irradiance of a face, W/m²; w: 1 if it has samples.
vec4 mergedIrradiance(uint face, float scale) {
#if WRITE == WRITE_AVERAGE
    const float weight = float(voxelWeights.data[face]) / WEIGHT_UNITS;
    if (weight == 0.0) return vec4(0.0);
    return vec4(vec3(voxelSums.data[face * 3u], voxelSums.data[face * 3u + 1u], voxelSums.data[face * 3u + 2u]) /
                    (scale * weight), 1.0);
#elif WRITE == WRITE_MAX
    return vec4(uintBitsToFloat(voxelSums.data[face * 3u]), uintBitsToFloat(voxelSums.data[face * 3u + 1u]),
                uintBitsToFloat(voxelSums.data[face * 3u + 2u]), voxelWeights.data[face]);
#elif WRITE == WRITE_MOVING_AVERAGE
    const vec4 mean = unpackUnorm4x8(voxelSums.data[face]);
    return vec4(mean.rgb / scale, mean.a > 0.0 ? 1.0 : 0.0);
#else
    return voxelSums.data[face];
#endif
}

#endif
