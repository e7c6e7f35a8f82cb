// The windows of a radiance clipmap in a buffer, filtered in shaders (layout: clipmap).
#ifndef VOXRAY_RADIANCE_CLIPMAP_BUFFER_GLSL
#define VOXRAY_RADIANCE_CLIPMAP_BUFFER_GLSL

#include "passes/cones/radiance/radiance_texel.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 8) buffer ClipmapValues { uvec2 data[]; };
layout(scalar) readonly buffer RadianceVoxels {
    RadianceGrid grid;
    uint side;
    uint firstWhole;
    ClipmapWindow window[RADIANCE_CLIPMAP_LEVELS];
    ClipmapValues values;  // By window, slot and direction: passes/cones/radiance/radiance_texel.glsl.
} radianceVoxels;

#define NO_SLOT 0xffffffffu

#define CLIPMAP_SLOT uint
uint slotIn(ClipmapWindow w, ivec3 voxel) {
    const uvec3 slot = uvec3(voxel) & (radianceVoxels.side - 1u);
    return w.slotOffset + (slot.z * w.size.y + slot.y) * w.size.x + slot.x;
}
uint clipmapSlot(uint level, ivec3 voxel) { return slotIn(radianceVoxels.window[level], voxel); }

vec4 radianceValue(uint slot, uint face) {
    return unpackRadiance(radianceVoxels.values.data[slot * radianceVoxels.grid.directions + face]);
}

void storeRadiance(uint slot, uint face, vec4 value) {
    radianceVoxels.values.data[slot * radianceVoxels.grid.directions + face] = packRadiance(value);
}

vec4 quantizedRadiance(vec4 value) { return unpackRadiance(packRadiance(value)); }

#include "passes/cones/radiance/radiance_interpolation.glsl"

vec4 sampleWindow(uint level, vec3 position, vec3 direction) {
    const ClipmapWindow w = radianceVoxels.window[level];
    vec3 fraction;
    const ivec3 corner = cornerVoxel(level, position, fraction);
    uint slot[8];
    for (uint octant = 0u; octant < 8u; ++octant) {
        const ivec3 voxel = blockVoxel(corner, octant);
        slot[octant] = inWindow(w, voxel) && octantWeight(octant, fraction) > 0.0 ? slotIn(w, voxel) : NO_SLOT;
    }
    return interpolateBlock(slot, fraction, direction);
}

#endif
