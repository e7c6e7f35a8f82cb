// What a ray meets where the device's sampler filters each face. The including layout has declared
//  - radianceVoxels;
//  - vec4 filteredFace(uint level, vec3 place, uint face): one face at a place in voxels of a level, in units of the grid's radiance.
//    `face`: 0 to 5 for +x -x +y -y +z -z, 0 with one value for all.
#ifndef VOXRAY_RADIANCE_FILTERED_FACES_GLSL
#define VOXRAY_RADIANCE_FILTERED_FACES_GLSL

#include "passes/cones/radiance/radiance_filter.glsl"

vec4 filteredFaces(uint level, vec3 position, vec3 direction) {
    const RadianceGrid g = radianceVoxels.grid;
    const vec3 place = placeInLevel(g, level, position);
    vec4 met = vec4(0.0);
    if (g.directions == 1u) {
        met = filteredFace(level, place, 0u);
    } else {
        for (uint axis = 0u; axis < 3u; ++axis)
            if (direction[axis] != 0.0)
                met += abs(direction[axis]) * filteredFace(level, place, 2u * axis + (direction[axis] > 0.0 ? 1u : 0u));
    }
    return vec4(g.unit * met.rgb, met.a);
}

#endif
