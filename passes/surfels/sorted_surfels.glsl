// Reads surfels that are sorted by voxel.
#ifndef VOXRAY_SORTED_SURFELS_GLSL
#define VOXRAY_SORTED_SURFELS_GLSL

#include "passes/surfels/sorted_surfels.h"

// gpu::SortedSurfel, in two vectors each: software Vulkan takes as long for a vector as for a number.
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer SortedSurfelWords { uvec4 data[]; };

SortedSurfel sortedSurfel(SortedSurfelWords words, uint slot) {
    const uvec4 place = words.data[2u * slot], side = words.data[2u * slot + 1u];
    return SortedSurfel(uintBitsToFloat(place.xyz), place.w, uintBitsToFloat(side.xyz), side.w);
}

#endif
