// Radiance and opacity along a direction, from faces that the sampler filters. The including layout has declared
//  - radianceVoxels;
//  - vec4 filteredFace(uint level, vec3 coordinates, uint face): one face, interpolated at coordinates in voxels of a
//    level, in units of the grid's radiance. `face`: 0 to 5 for +x -x +y -y +z -z, 0 with one value for all.
#ifndef VOXRAY_RADIANCE_FILTERED_FACES_GLSL
#define VOXRAY_RADIANCE_FILTERED_FACES_GLSL

#include "passes/cones/radiance/radiance_filter.glsl"

vec4 filteredFaces(uint level, vec3 position, vec3 direction) {
    const RadianceGrid g = radianceVoxels.grid;
    const vec3 coordinates = levelCoordinates(g, level, position);
    vec4 sum = vec4(0.0);
    if (g.directions == 1u) {
        sum = filteredFace(level, coordinates, 0u);
    } else {
        for (uint axis = 0u; axis < 3u; ++axis)
            if (direction[axis] != 0.0)
                sum += abs(direction[axis]) *
                       filteredFace(level, coordinates, 2u * axis + (direction[axis] > 0.0 ? 1u : 0u));
    }
    return vec4(g.unit * sum.rgb, sum.a);
}

#endif
