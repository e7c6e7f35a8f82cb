// Linear interpolation between the voxels of one level, the same for every layout. The including layout has declared
//  - radianceVoxels;
//  - NO_PLACE: the place of a voxel that is empty or outside;
//  - vec4 radianceValue(uint place, uint face): what a voxel stores. `face`: 0 to 5 for +x -x +y -y +z -z, 0 with one value for all.
#ifndef VOXRAY_RADIANCE_INTERPOLATION_GLSL
#define VOXRAY_RADIANCE_INTERPOLATION_GLSL

#include "passes/cones/radiance/radiance_filter.glsl"

// The first of the two voxels along each axis between whose centers a position lies, and how far it is on the way to the second.
ivec3 cornerVoxel(uint level, vec3 position, out vec3 at) {
    const vec3 place = placeInLevel(radianceVoxels.grid, level, position);
    const vec3 corner = floor(place);
    at = place - corner;
    return ivec3(corner);
}

// What a ray along `direction` meets between the eight voxels of a block, which stand at `place`.
vec4 interpolateBlock(uint place[8], vec3 at, vec3 direction) {
    vec4 value[8];
    vec4 sum = vec4(0.0);
    const bool faces = radianceVoxels.grid.directions == 6u;
    for (uint axis = 0u; axis < (faces ? 3u : 1u); ++axis) {
        const uint face = 2u * axis + (direction[axis] > 0.0 ? 1u : 0u);
        if (faces && direction[axis] == 0.0) continue;
        for (uint octant = 0u; octant < 8u; ++octant)
            value[octant] = place[octant] == NO_PLACE ? vec4(0.0) : radianceValue(place[octant], faces ? face : 0u);
        sum += faces ? abs(direction[axis]) * interpolateFaces(value, face, at) : interpolateAll(value, at);
    }
    return sum;
}

#endif
