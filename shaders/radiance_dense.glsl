// Radiance voxels in full grids, one for each level (layout: dense). A voxel's values stand side by side, four half floats each.
#ifndef VOXRAY_RADIANCE_DENSE_GLSL
#define VOXRAY_RADIANCE_DENSE_GLSL

#extension GL_EXT_buffer_reference : require

#include "shaders/radiance_filter.glsl"
#include "shaders/shared/radiance_dense_types.h"

// By address: a grid outgrows what devices bind as one buffer.
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer RadianceValues { uvec2 data[]; };
layout(set = 0, binding = 26, scalar) readonly buffer RadianceVoxels {
    RadianceGrid grid;
    RadianceValues values;
    DenseLevel level[RADIANCE_DENSE_LEVELS];
} radianceVoxels;

uint radianceIndex(DenseLevel level, ivec3 voxel) {
    const uvec3 v = uvec3(voxel);
    return level.first + (v.z * level.resolution.y + v.y) * level.resolution.x + v.x;
}

// `side`: 0 to 5 by facing direction, 0 where all share one.
vec4 radianceValue(uint index, uint side) {
    const uvec2 packed = radianceVoxels.values.data[index * radianceVoxels.grid.directions + side];
    return vec4(unpackHalf2x16(packed.x), unpackHalf2x16(packed.y));
}

// Bounded to what half floats hold: 65504 units of radiance.
void storeRadiance(uint index, uint side, vec4 value) {
    const vec4 bounded = min(value, vec4(65504.0));
    radianceVoxels.values.data[index * radianceVoxels.grid.directions + side] =
        uvec2(packHalf2x16(bounded.rg), packHalf2x16(bounded.ba));
}

vec4 sampleLevel(uint level, vec3 position, vec3 direction) {
    const RadianceGrid g = radianceVoxels.grid;
    const DenseLevel d = radianceVoxels.level[level];
    // To 1/1024 of a voxel, so that positions in the middle of a layer read that layer alone.
    const vec3 inLevel = round(((position - g.origin) / (g.voxelSize * float(1u << level)) - 0.5) * 1024.0) / 1024.0;
    const ivec3 corner = ivec3(floor(inLevel));
    const vec3 at = inLevel - vec3(corner);

    // The eight voxels round the position that lie in the grid; nothing is outside.
    uint index[8];
    bool inside[8];
    for (uint cell = 0u; cell < 8u; ++cell) {
        const ivec3 voxel = corner + ivec3(cell & 1u, (cell >> 1) & 1u, cell >> 2);
        inside[cell] = cellWeight(cell, at) > 0.0 && all(greaterThanEqual(voxel, ivec3(0))) &&
                       all(lessThan(voxel, ivec3(d.resolution)));
        index[cell] = inside[cell] ? radianceIndex(d, voxel) : 0u;
    }

    vec4 value[8];
    vec4 sum = vec4(0.0);
    const bool sides = g.directions == 6u;
    for (uint axis = 0u; axis < (sides ? 3u : 1u); ++axis) {
        const uint face = 2u * axis + (direction[axis] > 0.0 ? 1u : 0u);
        if (sides && direction[axis] == 0.0) continue;
        for (uint cell = 0u; cell < 8u; ++cell)
            value[cell] = inside[cell] ? radianceValue(index[cell], sides ? face : 0u) : vec4(0.0);
        sum += sides ? abs(direction[axis]) * interpolateFaces(value, face, at) : interpolateAll(value, at);
    }
    return vec4(g.unit * sum.rgb, sum.a);
}

// Metres from `position` along `direction` that hold nothing at this footprint: 0 where something may be here. Full grids keep
// nothing that tells.
float emptyDistance(vec3 position, float footprint, vec3 direction) { return 0.0; }

// Side of the finest voxel that describes the surroundings of `position` (m).
float finestFootprint(vec3 position) { return radianceVoxels.grid.voxelSize; }

#endif
