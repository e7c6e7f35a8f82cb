// The windows of a radiance clipmap in one 3D texture that the device's sampler filters (layout: clipmap_textures), in blocks: one for
// each level and face, of a level side by side along x. Round a block lies a border of one texel, which repeats what stands at the
// block's other end where slots go round, and is empty where the window holds all of the grid: so the sampler filters a block as if it
// were a texture of its own with repeat addressing, and never reads another one.
//
//      slots   7 | 0 1 2 3 4 5 6 7 | 0
#ifndef VOXRAY_RADIANCE_CLIPMAP_TEXTURES_GLSL
#define VOXRAY_RADIANCE_CLIPMAP_TEXTURES_GLSL

layout(scalar) readonly buffer RadianceVoxels {
    RadianceGrid grid;
    uint side;
    uint firstWhole;
    ClipmapWindow window[RADIANCE_CLIPMAP_LEVELS];
    uvec3 extent;                          // Texels of the texture.
    uvec3 block[RADIANCE_CLIPMAP_LEVELS];  // Texel of slot 0 of a level's first face.
} radianceVoxels;

uniform sampler3D radianceTexture;
layout(rgba16f) uniform writeonly image3D radianceTarget;

#define CLIPMAP_SLOT ivec4  // A slot along each axis, and the level.
ivec4 clipmapSlot(uint level, ivec3 voxel) { return ivec4(voxel & int(radianceVoxels.side - 1u), level); }

// Texel of slot 0 of a face.
ivec3 blockOf(uint level, uint face) {
    return ivec3(radianceVoxels.block[level] + uvec3(face * (radianceVoxels.window[level].size.x + 2u), 0u, 0u));
}

// The numbers that stand for a value: in units of the grid's radiance, bounded to what half floats hold.
vec4 halfFloats(vec4 value) {
    const vec4 number = min(vec4(value.rgb / radianceVoxels.grid.unit, value.a), vec4(65504.0));
    return vec4(unpackHalf2x16(packHalf2x16(number.rg)), unpackHalf2x16(packHalf2x16(number.ba)));
}
vec4 inUnits(vec4 number) { return vec4(radianceVoxels.grid.unit * number.rgb, number.a); }

vec4 radianceValue(ivec4 slot, uint face) {
    return inUnits(texelFetch(radianceTexture, blockOf(slot.w, face) + slot.xyz, 0));
}

vec4 storedRadiance(vec4 value) { return inUnits(halfFloats(value)); }

void storeRadiance(ivec4 slot, uint face, vec4 value) {
    const ivec3 texel = blockOf(slot.w, face) + slot.xyz;
    const vec4 number = halfFloats(value);

    // At the block's ends also into the border, at the other end.
    const ivec3 side = ivec3(radianceVoxels.side);
    const ivec3 goesRound = ivec3(equal(ivec3(radianceVoxels.window[slot.w].size), side));
    const ivec3 end = ivec3(equal(slot.xyz, ivec3(0))) - ivec3(equal(slot.xyz, side - 1));
    const ivec3 copies = abs(end) * goesRound;
    for (int z = 0; z <= copies.z; ++z)
        for (int y = 0; y <= copies.y; ++y)
            for (int x = 0; x <= copies.x; ++x)
                imageStore(radianceTarget, texel + ivec3(x, y, z) * end * side, number);
}

// Outside of the window is nothing: a place there reads the nearest one in it, and counts as far as linear interpolation with nothing
// lets it.
vec4 filteredFace(uint level, vec3 place, uint face) {
    const ClipmapWindow w = radianceVoxels.window[level];
    const vec3 nearest = clamp(place, vec3(w.first), vec3(w.first + ivec3(w.size) - 1));
    const vec3 part = max(1.0 - abs(place - nearest), 0.0);
    const vec3 texel = vec3(blockOf(level, face)) + mod(nearest, float(radianceVoxels.side)) + 0.5;
    return part.x * part.y * part.z * textureLod(radianceTexture, texel / vec3(radianceVoxels.extent), 0.0);
}

#include "passes/cones/radiance/radiance_filtered_faces.glsl"

vec4 sampleWindow(uint level, vec3 position, vec3 direction) { return filteredFaces(level, position, direction); }

#endif
