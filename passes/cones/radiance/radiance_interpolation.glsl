// Trilinear interpolation between the voxels of one level. The including layout has declared
//  - radianceVoxels;
//  - NO_VALUE: of a voxel that is empty or outside;
//  - vec4 radianceValue(uint index, uint face): the stored value. `face`: 0 to 5 for +x -x +y -y +z -z, 0 with one value
//    for all.
#ifndef VOXRAY_RADIANCE_INTERPOLATION_GLSL
#define VOXRAY_RADIANCE_INTERPOLATION_GLSL

#include "passes/cones/radiance/radiance_filter.glsl"

// The lower corner of the 2x2x2 voxels between whose centers a position lies, and its fractional coordinates between
// them.
ivec3 cornerVoxel(uint level, vec3 position, out vec3 fraction) {
    const vec3 coordinates = levelCoordinates(radianceVoxels.grid, level, position);
    const vec3 corner = floor(coordinates);
    fraction = coordinates - corner;
    return ivec3(corner);
}

// Radiance and opacity along `direction`, interpolated between the eight voxels of a block, whose values are at `indices`, by octant.
vec4 interpolateBlock(uint indices[8], vec3 fraction, vec3 direction) {
    vec4 value[8];
    vec4 sum = vec4(0.0);
    const bool faces = radianceVoxels.grid.directions == 6u;
    for (uint axis = 0u; axis < (faces ? 3u : 1u); ++axis) {
        const uint face = 2u * axis + (direction[axis] > 0.0 ? 1u : 0u);
        if (faces && direction[axis] == 0.0) continue;
        for (uint octant = 0u; octant < 8u; ++octant)
            value[octant] = indices[octant] == NO_VALUE ? vec4(0.0) : radianceValue(indices[octant], faces ? face : 0u);
        sum += faces ? abs(direction[axis]) * interpolateFaces(value, face, fraction) : interpolateAll(value, fraction);
    }
    return sum;
}

#endif
