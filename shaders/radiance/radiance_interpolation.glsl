// Linear interpolation between the voxels of one level, the same for every layout. The including layout has declared
//  - radianceVoxels;
//  - NO_PLACE: the place of a voxel that is empty or outside;
//  - vec4 radianceValue(uint place, uint side): what a voxel stores. `side`: 0 to 5 by facing direction, 0 where all share one.
#ifndef VOXRAY_RADIANCE_INTERPOLATION_GLSL
#define VOXRAY_RADIANCE_INTERPOLATION_GLSL

#include "shaders/radiance/radiance_filter.glsl"

// The first of the two voxels along each axis between whose centers a position lies, and how far it is on the way to the second:
// to 1/1024 of a voxel, so that positions in the center of a layer read that layer alone.
ivec3 cornerVoxel(uint level, vec3 position, out vec3 at) {
    const RadianceGrid g = radianceVoxels.grid;
    const vec3 inLevel = round(((position - g.origin) / (g.voxelSize * float(1u << level)) - 0.5) * 1024.0) / 1024.0;
    const vec3 corner = floor(inLevel);
    at = inLevel - corner;
    return ivec3(corner);
}

// One of the eight voxels from `corner` on.
ivec3 blockVoxel(ivec3 corner, uint cell) { return corner + ivec3(cell & 1u, (cell >> 1) & 1u, cell >> 2); }

// What a ray along `direction` meets between the eight voxels of a block, which stand at `place`.
vec4 interpolateBlock(uint place[8], vec3 at, vec3 direction) {
    vec4 value[8];
    vec4 sum = vec4(0.0);
    const bool sides = radianceVoxels.grid.directions == 6u;
    for (uint axis = 0u; axis < (sides ? 3u : 1u); ++axis) {
        const uint face = 2u * axis + (direction[axis] > 0.0 ? 1u : 0u);
        if (sides && direction[axis] == 0.0) continue;
        for (uint cell = 0u; cell < 8u; ++cell)
            value[cell] = place[cell] == NO_PLACE ? vec4(0.0) : radianceValue(place[cell], sides ? face : 0u);
        sum += sides ? abs(direction[axis]) * interpolateFaces(value, face, at) : interpolateAll(value, at);
    }
    return sum;
}

#endif
