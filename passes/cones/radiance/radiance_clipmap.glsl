// Radiance voxels in a clipmap (layouts clipmap and clipmap_textures): docs/clipmap.md.
#ifndef VOXRAY_RADIANCE_CLIPMAP_GLSL
#define VOXRAY_RADIANCE_CLIPMAP_GLSL

#include "passes/cones/radiance/radiance_clipmap_types.h"

bool inWindow(ClipmapWindow w, ivec3 voxel) {
    return all(greaterThanEqual(voxel, w.first)) && all(lessThan(voxel, w.first + ivec3(w.size)));
}

// How windows are stored. The file that is included declares
//  - radianceVoxels, a buffer with a RadianceGrid `grid`; `side`, the voxels along an axis that a window holds at most, a power of
//    two; `firstWhole`, the first level that is held whole, as are all after it; and the windows by level, `window`;
//  - CLIPMAP_SLOT clipmapSlot(uint level, ivec3 voxel): where a voxel in the window of a level stands: its coordinates modulo the
//    window's side, so that what stays in the window stays in place when the window moves;
//  - vec4 radianceValue(CLIPMAP_SLOT slot, uint face), and storeRadiance(slot, face, value) for shaders that fill windows. `face`: 0 to
//    5 for +x -x +y -y +z -z, 0 with one value for all;
//  - vec4 storedRadiance(vec4 value): a value as it is after it was stored;
//  - vec4 sampleWindow(uint level, vec3 position, vec3 direction): what a window holds, interpolated; nothing outside of it.
#ifdef RADIANCE_CLIPMAP_TEXTURES
#include "passes/cones/radiance/radiance_clipmap_textures.glsl"
#else
#include "passes/cones/radiance/radiance_clipmap_buffer.glsl"
#endif

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

// Where the window of a level ends, coarser levels stand in for it. A layer of a coarser level is thicker: its values are scaled by
// the ratio of the thicknesses, so that a surface has the same opacity on all levels.
#ifdef RADIANCE_CLIPMAP_TEXTURES
// In a loop: lavapipe copies its filter's code to each place that calls it, and takes long to compile.
vec4 sampleLevel(uint level, vec3 position, vec3 direction) {
    const float finest = max(minimumLevel(position), float(level));
    const uint finer = uint(finest);
    const float part = finest - float(finer);
    vec4 met = vec4(0.0);
    for (uint l = finer; l <= (part > 0.0 ? finer + 1u : finer); ++l)
        met += (l == finer ? 1.0 - part : part) * exp2(float(level) - float(l)) * sampleWindow(l, position, direction);
    return met;
}
#else
vec4 sampleLevel(uint level, vec3 position, vec3 direction) {
    const float finest = minimumLevel(position);
    if (float(level) >= finest) return sampleWindow(level, position, direction);
    const uint finer = uint(finest);
    const float part = finest - float(finer);
    vec4 met = (1.0 - part) * exp2(float(level) - float(finer)) * sampleWindow(finer, position, direction);
    if (part > 0.0) met += part * exp2(float(level) - float(finer) - 1.0) * sampleWindow(finer + 1u, position, direction);
    return met;
}
#endif

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
