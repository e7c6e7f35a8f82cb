// What a lookup needs of a surfel, in 64 bits: reading them is what a lookup costs. Written by passes/link_surfels/.
#ifndef VOXRAY_PACKED_SURFEL_GLSL
#define VOXRAY_PACKED_SURFEL_GLSL

#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_buffer_reference : require
#include "shaders/scene/octahedral.glsl"

// x: place in the surfel's voxel, 10 bits an axis, and whether the surfel is covered; y: normal, octahedral. A vector is one load for
// software Vulkan, a struct would be two.
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer PackedSurfels { uvec2 data[]; };

// The same and z: irradiance, as shaders/surfels/radiosity.glsl packs it.
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer LitSurfels { uvec3 data[]; };

// A surfel that fell between two voxels belongs to a voxel next to its own: places reach one voxel out of it.
const float PLACE_STEPS = 1024.0 / 3.0;  // A voxel.

// inVoxel: from the voxel's corner, in voxels, -1 to 2. Rounds to the center of a step.
uvec2 packSurfel(vec3 inVoxel, vec3 normal, bool isCovered) {
    const uvec3 steps = uvec3(clamp((inVoxel + 1.0) * PLACE_STEPS, vec3(0.0), vec3(1023.0)));
    return uvec2(steps.x | steps.y << 10 | steps.z << 20 | uint(isCovered) << 30, toOctahedral(normal));
}

vec3 placeInVoxel(uint place) {
    return (vec3(place & 1023u, place >> 10 & 1023u, place >> 20 & 1023u) + 0.5) / PLACE_STEPS - 1.0;
}

bool isCoveredSurfel(uint place) { return (place >> 30) != 0u; }

#endif
