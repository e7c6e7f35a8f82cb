// Radiance voxels in full grids, one for each level (layout: dense). A voxel's values are adjacent, four half floats
// each.
#ifndef VOXRAY_RADIANCE_DENSE_GLSL
#define VOXRAY_RADIANCE_DENSE_GLSL

// By address: a grid may exceed the maximum size of a bound buffer.
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer RadianceValues { uvec2 data[]; };
layout(scalar) readonly buffer RadianceVoxels {
    RadianceGrid grid;
    RadianceValues values;
    DenseLevel level[RADIANCE_DENSE_LEVELS];
} radianceVoxels;

#define NO_VALUE 0xffffffffu
uint radianceIndex(DenseLevel level, ivec3 voxel) {
    const uvec3 v = uvec3(voxel);
    return level.first + (v.z * level.resolution.y + v.y) * level.resolution.x + v.x;
}

// `face`: 0 to 5 for +x -x +y -y +z -z, 0 with one value for all.
vec4 radianceValue(uint index, uint face) {
    const uvec2 packed = radianceVoxels.values.data[index * radianceVoxels.grid.directions + face];
    return vec4(unpackHalf2x16(packed.x), unpackHalf2x16(packed.y));
}

// Clamped to the range of half floats.
void storeRadiance(uint index, uint face, vec4 value) {
    const vec4 clamped = min(value, vec4(65504.0));
    radianceVoxels.values.data[index * radianceVoxels.grid.directions + face] =
        uvec2(packHalf2x16(clamped.rg), packHalf2x16(clamped.ba));
}

// Levels as the shaders that fill them address them.
#define RADIANCE_LEVEL DenseLevel
DenseLevel radianceLevel(uint level) { return radianceVoxels.level[level]; }

#include "passes/cones/radiance/radiance_interpolation.glsl"

vec4 sampleLevel(uint level, vec3 position, vec3 direction) {
    const DenseLevel d = radianceVoxels.level[level];
    vec3 fraction;
    const ivec3 corner = cornerVoxel(level, position, fraction);
    uint indices[8];
    for (uint octant = 0u; octant < 8u; ++octant) {
        const ivec3 voxel = blockVoxel(corner, octant);
        const bool inside = all(greaterThanEqual(voxel, ivec3(0))) && all(lessThan(voxel, ivec3(d.resolution)));
        indices[octant] = inside && octantWeight(octant, fraction) > 0.0 ? radianceIndex(d, voxel) : NO_VALUE;
    }
    const vec4 value = interpolateBlock(indices, fraction, direction);
    return vec4(radianceVoxels.grid.unit * value.rgb, value.a);
}

uint startLevel(vec3 position, float dither) { return 0u; }

#endif
