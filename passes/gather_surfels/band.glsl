// A band of the image's rows: what is kept of each surface in a pixel, and what tells surfels near it.
#ifndef VOXRAY_GATHER_SURFELS_BAND_GLSL
#define VOXRAY_GATHER_SURFELS_BAND_GLSL

#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_buffer_reference : require
#include "passes/gather_surfels/pixel_surface.h"
#include "shaders/surfels/sorted_surfels.h"
#include "shaders/surfels/surfel_bias.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 8, local_size_y = 8) in;

readonly buffer Begins { uint data[]; } begins;
readonly buffer Ends { uint data[]; } ends;
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer SortedSurfels { SortedSurfel data[]; };
layout(scalar) readonly buffer SortedAt { SortedSurfels sorted; };
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    ivec2 extent;  // Pixels of the band.
    int firstRow;
    float noise;  // Relative variance of a surfel's irradiance.
} push;

// SAMPLES, texels of the g-buffer along each side of a pixel, is defined by gather_surfels.cpp. A pixel has no more surfaces than
// texels; the first surfaces of all pixels come first.
#define SURFACES (SAMPLES * SAMPLES)

int surfaceIndex(ivec2 inBand, int surface) { return (surface * push.extent.y + inBand.y) * push.extent.x + inBand.x; }

// Between which eight voxels a point lies: the first of them, and how far towards the others.
struct Eight {
    ivec3 first;
    vec3 part;
};

Eight eightAround(vec3 p) {
    const vec3 center = (p - push.grid.origin) / push.grid.voxelSize - 0.5;
    return Eight(ivec3(floor(center)), fract(center));
}

#endif
