// Flux and area that voxels hold by face, packed (VoxelIrradiance in passes/common/voxels/voxels.h). Faces are numbered 6 * voxel +
// (+x -x +y -y +z -z), so that face / 2 numbers the pair of faces across an axis of a voxel.
#ifndef VOXRAY_PACKED_FLUX_GLSL
#define VOXRAY_PACKED_FLUX_GLSL

#include "shaders/compute/large_buffer.glsl"
#include "shaders/voxels/voxel_packing.h"

// W
vec3 loadFlux(LargeUints flux, uint face) {
    const uint at = face / 2u * FLUX_WORDS_PER_AXIS;
    return unpackFlux(flux.data[at + (face & 1u)], flux.data[at + 2u], (face & 1u) == 1u);
}

// Two faces share a word: both are stored by one thread.
void storeFlux(LargeUints flux, uint pair, vec3 positive, vec3 negative) {
    const uvec3 words = packFlux(positive, negative);
    for (uint k = 0u; k < 3u; ++k) flux.data[pair * FLUX_WORDS_PER_AXIS + k] = words[k];
}

// Area of a face in units of a voxel's face; `word`: of its pair.
float areaOf(uint word, uint face) { return unpackArea((face & 1u) == 0u ? lowerOf(word) : upperOf(word)); }

uint packAreas(float positive, float negative) { return packPair(packArea(positive), packArea(negative)); }

#endif
