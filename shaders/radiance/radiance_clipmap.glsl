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

// `side`: 0 to 5 by facing direction, 0 where all share one.
vec4 radianceValue(uint slot, uint side) {
    return unpackRadiance(radianceVoxels.values.data[slot * radianceVoxels.grid.directions + side]);
}

void storeRadiance(uint slot, uint side, vec4 value) {
    radianceVoxels.values.data[slot * radianceVoxels.grid.directions + side] = packRadiance(value);
}

// How far a position is from where a level's reach ends, along the nearest axis, in widths of the zone where the next level takes
// over: 1 and more, the level alone counts; 0 and less, it doesn't.
float windowShare(uint level, vec3 position) {
    const RadianceGrid g = radianceVoxels.grid;
    // Outside of the grid there is nothing: its border decides.
    const vec3 inGrid = clamp(position, g.origin, g.origin + g.voxelSize * vec3(g.resolution));
    const vec3 left = radianceVoxels.window[level].reach - abs(inGrid - radianceVoxels.window[level].center);
    return min(left.x, min(left.y, left.z)) * radianceVoxels.window[level].fall;
}

// The finest level that has a say at a position. Between two levels the part after the point is the coarser one's share: it grows
// to 1 before the window ends, by the distance to the camera itself. So nothing jumps when the window follows in whole voxels.
float minimumLevel(vec3 position) {
    for (uint level = 0u; level < radianceVoxels.firstWhole; ++level) {
        const float share = windowShare(level, position);
        if (share > 0.0) return float(level) + max(1.0 - share, 0.0);
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
    for (uint cell = 0u; cell < 8u; ++cell) {
        const ivec3 voxel = blockVoxel(corner, cell);
        place[cell] = inWindow(w, voxel) && cellWeight(cell, at) > 0.0 ? clipmapSlot(w, voxel) : NO_PLACE;
    }
    return interpolateBlock(place, at, direction);
}

// Where the level isn't held, the finest ones that are stand for it: for a layer of the level's voxels, the share of theirs that is
// as thick, so that a surface covers the same in all.
vec4 sampleLevel(uint level, vec3 position, vec3 direction) {
    const float finest = minimumLevel(position);
    if (float(level) >= finest) return sampleWindow(level, position, direction);
    const uint finer = uint(finest);
    const float part = finest - float(finer);
    vec4 met = (1.0 - part) * exp2(float(level) - float(finer)) * sampleWindow(finer, position, direction);
    if (part > 0.0) met += part * exp2(float(level) - float(finer) - 1.0) * sampleWindow(finer + 1u, position, direction);
    return met;
}

// Metres from `position` along `direction` that hold nothing at this footprint: 0 where something may be here. Windows keep nothing
// that tells.
float emptyDistance(vec3 position, float footprint, vec3 direction) { return 0.0; }

// The next level has a say from where a window's share is 1 on. A cone has to be clear of its voxels there; before that, over as
// wide a zone, more and more cones are, so that light doesn't jump where the level changes.
uint startLevel(vec3 position, float dither) {
    for (uint level = 0u; level < radianceVoxels.firstWhole; ++level) {
        const float share = windowShare(level, position);
        if (share > 0.0) return share - 1.0 < dither ? level + 1u : level;
    }
    return radianceVoxels.firstWhole;
}

#endif
