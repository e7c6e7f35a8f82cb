// Radiance voxels in a clipmap (layout: clipmap): docs/clipmap.md.
#ifndef VOXRAY_RADIANCE_CLIPMAP_GLSL
#define VOXRAY_RADIANCE_CLIPMAP_GLSL

#extension GL_EXT_buffer_reference : require

#include "shaders/radiance/radiance_texel.glsl"
#include "shaders/radiance/radiance_clipmap_types.h"

layout(buffer_reference, scalar, buffer_reference_align = 8) buffer ClipmapValues { uvec2 data[]; };
layout(scalar) readonly buffer RadianceVoxels {
    RadianceGrid grid;
    ClipmapValues values;  // By window, slot and direction: shaders/radiance/radiance_texel.glsl.
    uint side;             // Voxels along an axis that a window holds at most; a power of two.
    uint firstWhole;       // The first level that is held whole, as are all after it.
    ClipmapWindow window[RADIANCE_CLIPMAP_LEVELS];
} radianceVoxels;

bool inWindow(ClipmapWindow w, ivec3 voxel) {
    return all(greaterThanEqual(voxel, w.first)) && all(lessThan(voxel, w.first + ivec3(w.size)));
}

#define NO_PLACE 0xffffffffu

// Where a voxel in the window stands: its coordinates modulo the window's side, so that what stays in the window stays in place
// when the window moves.
uint clipmapSlot(ClipmapWindow w, ivec3 voxel) {
    const uvec3 slot = uvec3(voxel) & (radianceVoxels.side - 1u);
    return w.begin + (slot.z * w.size.y + slot.y) * w.size.x + slot.x;
}

// `face`: 0 to 5 for +x -x +y -y +z -z, 0 with one value for all.
vec4 radianceValue(uint slot, uint face) {
    return unpackRadiance(radianceVoxels.values.data[slot * radianceVoxels.grid.directions + face]);
}

void storeRadiance(uint slot, uint face, vec4 value) {
    radianceVoxels.values.data[slot * radianceVoxels.grid.directions + face] = packRadiance(value);
}

// The weight of a level at a position, against that of the next coarser one: 1 or more, the level alone counts; 0 or less, it does
// not. It falls linearly over a transition zone before the window's border, by the distance along the nearest axis; with
// RADIANCE_CLIPMAP_EUCLIDEAN, before the border of a ball, as in Arnebäck 2017, section 4.2.1.
float windowWeight(uint level, vec3 position) {
    const RadianceGrid g = radianceVoxels.grid;
    // Outside of the grid there is nothing: its border decides.
    const vec3 inGrid = clamp(position, g.origin, g.origin + g.voxelSize * vec3(g.resolution));
#ifdef RADIANCE_CLIPMAP_EUCLIDEAN
    return (radianceVoxels.window[level].reach.x - distance(inGrid, radianceVoxels.window[level].center)) *
           radianceVoxels.window[level].fall;
#else
    const vec3 left = radianceVoxels.window[level].reach - abs(inGrid - radianceVoxels.window[level].center);
    return min(left.x, min(left.y, left.z)) * radianceVoxels.window[level].fall;
#endif
}

// The finest level that counts at a position. Between two levels the fractional part is the coarser one's weight. It follows the
// camera itself and is 1 before the window ends: so nothing jumps when the window follows the camera in whole voxels.
float minimumLevel(vec3 position) {
    for (uint level = 0u; level < radianceVoxels.firstWhole; ++level) {
        const float weight = windowWeight(level, position);
        if (weight > 0.0) return float(level) + max(1.0 - weight, 0.0);
    }
    return float(radianceVoxels.firstWhole);
}

#include "shaders/radiance/radiance_interpolation.glsl"

// What a window holds, interpolated; nothing outside of it.
vec4 sampleWindow(uint level, vec3 position, vec3 direction) {
    const ClipmapWindow w = radianceVoxels.window[level];
    vec3 at;
    const ivec3 corner = cornerVoxel(level, position, at);
    uint place[8];
    for (uint octant = 0u; octant < 8u; ++octant) {
        const ivec3 voxel = blockVoxel(corner, octant);
        place[octant] = inWindow(w, voxel) && octantWeight(octant, at) > 0.0 ? clipmapSlot(w, voxel) : NO_PLACE;
    }
    return interpolateBlock(place, at, direction);
}

// Where the window of a level ends, coarser levels stand in for it. A layer of a coarser level is thicker: its values are scaled by
// the ratio of the thicknesses, so that a surface has the same opacity on all levels.
vec4 sampleLevel(uint level, vec3 position, vec3 direction) {
    const float finest = minimumLevel(position);
    if (float(level) >= finest) return sampleWindow(level, position, direction);
    const uint finer = uint(finest);
    const float part = finest - float(finer);
    vec4 met = (1.0 - part) * exp2(float(level) - float(finer)) * sampleWindow(finer, position, direction);
    if (part > 0.0) met += part * exp2(float(level) - float(finer) - 1.0) * sampleWindow(finer + 1u, position, direction);
    return met;
}

// The next level counts from where a window's weight falls below 1. A cone has to keep clear of its voxels there. In a zone as wide
// before that a growing part of the cones does so already, chosen by dithering, so that light doesn't jump where the level changes.
uint startLevel(vec3 position, float dither) {
    for (uint level = 0u; level < radianceVoxels.firstWhole; ++level) {
        const float weight = windowWeight(level, position);
        if (weight > 0.0) return weight - 1.0 < dither ? level + 1u : level;
    }
    return radianceVoxels.firstWhole;
}

#endif
