// Flux into voxels, summed by face in fixed point. Host: passes/common/voxels/flux_accumulator.h.
#ifndef VOXRAY_FLUX_ACCUMULATOR_GLSL
#define VOXRAY_FLUX_ACCUMULATOR_GLSL

#include "shaders/voxels/face.glsl"
#include "shaders/compute/large_buffer.glsl"

// All lights' power is 2 to this in units of the sums.
#define FLUX_POWER_BITS 56.0

layout(buffer_reference, scalar, buffer_reference_align = 8) buffer FluxAccumulator { uint64_t data[]; };
layout(scalar) readonly buffer FluxAccumulatorRef { FluxAccumulator fluxAccumulator; };  // 3 a face

// A surface's flux goes to the three faces that it turns to, by the squares of its normal's components.
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
