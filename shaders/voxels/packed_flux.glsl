// Packed flux and area of voxels by face (VoxelIrradiance in passes/common/voxels/voxels.h). Faces have the indices 6 *
// voxel + (+x -x +y -y +z -z), so that face / 2 is the index of the pair of faces across an axis.
#ifndef VOXRAY_PACKED_FLUX_GLSL
#define VOXRAY_PACKED_FLUX_GLSL

#include "shaders/compute/large_buffer.glsl"
#include "shaders/voxels/voxel_packing.h"

// W
vec3 loadFlux(LargeUints flux, uint face) {
    const uint word = face / 2u * FLUX_WORDS_PER_AXIS;
    return unpackFlux(flux.data[word + (face & 1u)], flux.data[word + 2u], (face & 1u) == 1u);
}

// Stores the flux of both faces of a pair, which share a word.
void storeFlux(LargeUints flux, uint pair, vec3 positive, vec3 negative) {
    const uvec3 words = packFlux(positive, negative);
    for (uint k = 0u; k < 3u; ++k) flux.data[pair * FLUX_WORDS_PER_AXIS + k] = words[k];
}

// Area in units of a voxel's face, from the word of its pair.
float areaOf(uint word, uint face) { return unpackArea((face & 1u) == 0u ? lowerOf(word) : upperOf(word)); }

uint packAreas(float positive, float negative) { return packPair(packArea(positive), packArea(negative)); }

#endif
