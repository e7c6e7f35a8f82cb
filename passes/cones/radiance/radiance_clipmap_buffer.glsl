// The windows of a radiance clipmap in a buffer, filtered in shaders (layout: clipmap).
#ifndef VOXRAY_RADIANCE_CLIPMAP_BUFFER_GLSL
#define VOXRAY_RADIANCE_CLIPMAP_BUFFER_GLSL

#include "passes/cones/radiance/radiance_texel.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 8) buffer ClipmapValues { uvec2 data[]; };
layout(scalar) readonly buffer RadianceVoxels {
    RadianceGrid grid;
    uint windowSize;
    uint firstWhole;
    ClipmapWindow window[RADIANCE_CLIPMAP_LEVELS];
    ClipmapValues values;  // By window, index and direction: passes/cones/radiance/radiance_texel.glsl.
} radianceVoxels;

#define NO_VALUE 0xffffffffu

#define RADIANCE_INDEX uint
uint indexInWindow(ClipmapWindow w, ivec3 voxel) {
    const uvec3 wrapped = uvec3(voxel) & (radianceVoxels.windowSize - 1u);
    return w.firstIndex + (wrapped.z * w.size.y + wrapped.y) * w.size.x + wrapped.x;
}
uint radianceIndex(uint level, ivec3 voxel) { return indexInWindow(radianceVoxels.window[level], voxel); }

vec4 radianceValue(uint index, uint face) {
    return unpackRadiance(radianceVoxels.values.data[index * radianceVoxels.grid.directions + face]);
}

void storeRadiance(uint index, uint face, vec4 value) {
    radianceVoxels.values.data[index * radianceVoxels.grid.directions + face] = packRadiance(value);
}

vec4 quantizedRadiance(vec4 value) { return unpackRadiance(packRadiance(value)); }

#include "passes/cones/radiance/radiance_interpolation.glsl"

vec4 sampleWindow(uint level, vec3 position, vec3 direction) {
    const ClipmapWindow w = radianceVoxels.window[level];
    vec3 fraction;
    const ivec3 corner = cornerVoxel(level, position, fraction);
    uint indices[8];
    for (uint octant = 0u; octant < 8u; ++octant) {
        const ivec3 voxel = blockVoxel(corner, octant);
        indices[octant] =
            inWindow(w, voxel) && octantWeight(octant, fraction) > 0.0 ? indexInWindow(w, voxel) : NO_VALUE;
    }
    return interpolateBlock(indices, fraction, direction);
}

#endif
