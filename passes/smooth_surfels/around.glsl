// The surfels around each surfel: those of the 27 voxels about it that lie within a voxel's size. Whoever includes this calls
// around(slot) and defines
//     void visit(uint slot, float bias, float kernel)
// for each of them, itself too: how much their irradiance may differ for geometry's sake (surfel_bias.glsl), and a weight that falls
// with distance, 1 to 0.
#ifndef VOXRAY_SMOOTH_SURFELS_AROUND_GLSL
#define VOXRAY_SMOOTH_SURFELS_AROUND_GLSL

#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_buffer_reference : require
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/sampling.glsl"
#include "shaders/surfels/packed_surfel.glsl"
#include "shaders/surfels/radiosity.glsl"
#include "shaders/surfels/sorted_surfels.glsl"
#include "shaders/surfels/surfel_bias.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

// Of the light around a surfel.
struct Surroundings {
    float mean;      // Luminance of irradiance, W/m².
    float variance;  // Of a single surfel's.
    float ofMean;    // Variance of the mean.
};

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer AllSurroundings { Surroundings data[]; };
layout(scalar) readonly buffer SortedAt { SortedSurfelWords sorted; };
layout(scalar) readonly buffer LitAt { LitSurfels lit; };
layout(scalar) readonly buffer SurroundingsAt { AllSurroundings surroundings; };
readonly buffer Lists { uvec2 data[]; } lists;
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint count;
    float noise;  // Relative variance of a surfel's irradiance, roughly.
} push;

void visit(uint slot, float bias, float kernel);

void around(uint slot) {
    SortedSurfelWords words = sorted;  // The address is read once: no compiler takes it out of the loops.
    const SortedSurfel own = sortedSurfel(words, slot);
    const ivec3 voxel = voxelAt(push.grid, own.position);
    const float squaredSize = push.grid.voxelSize * push.grid.voxelSize;
    for (int i = 0; i < 27; ++i) {
        const uint number = voxelNumber(push.grid, voxel + ivec3(i % 3, (i / 3) % 3, i / 9) - 1);
        if (number == NO_VOXEL) continue;
        const uvec2 slots = lists.data[number];
        for (uint j = slots.x; j < slots.y; ++j) {
            const SortedSurfel s = sortedSurfel(words, j);
            const vec3 away = s.position - own.position;
            const float squared = dot(away, away);
            if (squared >= squaredSize || dot(s.normal, own.normal) <= 0.0) continue;
            if (((s.id ^ own.id) & VOXRAY_COVERED) != 0u) continue;  // Light in a gap says nothing of light before it.
            // Rounding must not part a surfel from itself: it may be all that is known.
            const float bias = j == slot ? 0.0 : surfelBias(own.position, own.normal, s.position, s.normal);
            visit(j, bias, 1.0 - squared / squaredSize);
        }
    }
}

#endif
