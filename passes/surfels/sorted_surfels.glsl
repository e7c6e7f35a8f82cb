// Reads surfels that are sorted by voxel.
#ifndef VOXRAY_SORTED_SURFELS_GLSL
#define VOXRAY_SORTED_SURFELS_GLSL

#include "passes/surfels/sorted_surfels.h"

// Two vectors for each SortedSurfel: software Vulkan takes as long for a vector as for a scalar.
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer SortedSurfelWords { uvec4 data[]; };

SortedSurfel sortedSurfel(SortedSurfelWords words, uint i) {
    const uvec4 first = words.data[2u * i], second = words.data[2u * i + 1u];
    return SortedSurfel(uintBitsToFloat(first.xyz), first.w, uintBitsToFloat(second.xyz), second.w);
}

#endif
