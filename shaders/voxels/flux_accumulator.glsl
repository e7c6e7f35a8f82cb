// Sums of flux by voxel face in fixed point (host: passes/common/voxels/flux_accumulator.h).
#ifndef VOXRAY_FLUX_ACCUMULATOR_GLSL
#define VOXRAY_FLUX_ACCUMULATOR_GLSL

#include "shaders/voxels/face.glsl"
#include "shaders/compute/large_buffer.glsl"

// log2 of the power of all lights in units of the sums.
#define FLUX_POWER_BITS 56.0

layout(buffer_reference, scalar, buffer_reference_align = 8) buffer FluxAccumulator { uint64_t data[]; };
layout(scalar) readonly buffer FluxAccumulatorRef { FluxAccumulator fluxAccumulator; };  // 3 a face

// Adds a surface's flux to the three faces that it faces, by the squared components of its normal.
void addFlux(uint voxel, vec3 normal, vec3 watts, float unitsPerWatt) {
    for (uint axis = 0u; axis < 3u; ++axis) {
        const float unitsPerSurfaceWatt = normal[axis] * normal[axis] * unitsPerWatt;
        const uint face = voxel * 6u + faceOf(normal, axis);
        for (uint c = 0u; c < 3u; ++c) {
            const uint64_t units = uint64_t(watts[c] * unitsPerSurfaceWatt);
            if (units > 0ul) atomicAdd(fluxAccumulator.data[face * 3u + c], units);
        }
    }
}

#endif
