// Radiance voxels in a clipmap (layouts clipmap and clipmap_textures): docs/clipmap.md.
#ifndef VOXRAY_RADIANCE_CLIPMAP_GLSL
#define VOXRAY_RADIANCE_CLIPMAP_GLSL

bool inWindow(ClipmapWindow w, ivec3 voxel) {
    return all(greaterThanEqual(voxel, w.first)) && all(lessThan(voxel, w.first + ivec3(w.size)));
}

// How windows are stored. The included file declares
//  - radianceVoxels, a buffer with a RadianceGrid `grid`; `windowSize`, the maximum size of a window in voxels, a power
//    of two; `firstWhole`, the finest level whose window is the level's whole grid; and the windows by level, `window`;
//  - RADIANCE_INDEX radianceIndex(uint level, ivec3 voxel): where a voxel of a level's window is stored. Addressing is
//    toroidal (coordinates modulo `windowSize`), so that voxels stay where they are when the window moves;
//  - vec4 radianceValue(RADIANCE_INDEX index, uint face), and storeRadiance(index, face, value) for shaders that fill
//    windows. `face`: 0 to 5 for +x -x +y -y +z -z, 0 with one value for all;
//  - vec4 quantizedRadiance(vec4 value): a value as it reads after it was stored;
//  - vec4 sampleWindow(uint level, vec3 position, vec3 direction): as sampleLevel(), from one window; 0 outside of it.
#ifdef RADIANCE_CLIPMAP_TEXTURES
#include "passes/cones/radiance/radiance_clipmap_textures.glsl"
#else
#include "passes/cones/radiance/radiance_clipmap_buffer.glsl"
#endif

// Levels as the shaders that fill them address them.
#define RADIANCE_LEVEL uint
uint radianceLevel(uint level) { return level; }

// Blend weight of a level against the next coarser one: from 1 on the level alone counts, up to 0 it does not count. It
// falls linearly over a transition zone before the window's border, by the maximum norm; with
// RADIANCE_CLIPMAP_EUCLIDEAN before the border of a ball, as in Arnebäck 2017, section 4.2.1.
float windowWeight(uint level, vec3 position) {
    const RadianceGrid g = radianceVoxels.grid;
    // Positions outside of the grid take the weight at its border.
    const vec3 inGrid = clamp(position, g.origin, g.origin + g.voxelSize * vec3(g.resolution));
#ifdef RADIANCE_CLIPMAP_EUCLIDEAN
    return (radianceVoxels.window[level].reach.x - distance(inGrid, radianceVoxels.window[level].center)) *
           radianceVoxels.window[level].falloff;
#else
    const vec3 remaining = radianceVoxels.window[level].reach - abs(inGrid - radianceVoxels.window[level].center);
    return min(remaining.x, min(remaining.y, remaining.z)) * radianceVoxels.window[level].falloff;
#endif
}

// The finest level that counts at a position, fractional in transition zones: its fraction is the coarser level's
// weight. The zone follows the camera continuously and ends before the window, so that nothing pops when the window
// moves by a voxel.
float minimumLevel(vec3 position) {
    for (uint level = 0u; level < radianceVoxels.firstWhole; ++level) {
        const float weight = windowWeight(level, position);
        if (weight > 0.0) return float(level) + max(1.0 - weight, 0.0);
    }
    return float(radianceVoxels.firstWhole);
}

// Beyond the window of a level coarser levels replace it. Their values are scaled by the ratio of the layers'
// thicknesses, so that a surface has the same opacity on all levels.
#ifdef RADIANCE_CLIPMAP_TEXTURES
// In a loop: lavapipe inlines its texture filter at each call, which takes long to compile.
vec4 sampleLevel(uint level, vec3 position, vec3 direction) {
    const float finest = max(minimumLevel(position), float(level));
    const uint finer = uint(finest);
    const float coarserWeight = finest - float(finer);
    vec4 sum = vec4(0.0);
    for (uint l = finer; l <= (coarserWeight > 0.0 ? finer + 1u : finer); ++l)
        sum += (l == finer ? 1.0 - coarserWeight : coarserWeight) * exp2(float(level) - float(l)) *
               sampleWindow(l, position, direction);
    return sum;
}
#else
vec4 sampleLevel(uint level, vec3 position, vec3 direction) {
    const float finest = minimumLevel(position);
    if (float(level) >= finest) return sampleWindow(level, position, direction);
    const uint finer = uint(finest);
    const float coarserWeight = finest - float(finer);
    vec4 sum = (1.0 - coarserWeight) * exp2(float(level) - float(finer)) * sampleWindow(finer, position, direction);
    if (coarserWeight > 0.0)
        sum += coarserWeight * exp2(float(level) - float(finer) - 1.0) * sampleWindow(finer + 1u, position, direction);
    return sum;
}
#endif

// Where a window's weight is below 1, the next level counts, and cones must start clear of its voxels. In a zone of
// equal width before that a growing fraction of the cones, chosen by dithering, does so already: light then changes
// gradually.
uint startLevel(vec3 position, float dither) {
    for (uint level = 0u; level < radianceVoxels.firstWhole; ++level) {
        const float weight = windowWeight(level, position);
        if (weight > 0.0) return weight - 1.0 < dither ? level + 1u : level;
    }
    return radianceVoxels.firstWhole;
}

#endif
