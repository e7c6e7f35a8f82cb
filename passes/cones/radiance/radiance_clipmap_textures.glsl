// The windows of a radiance clipmap in a 3D texture atlas that the sampler filters (layout: clipmap_textures): a block
// for each level and face, the faces of a level side by side along x. Each block has a border of one texel: a copy of
// the opposite end where coordinates wrap, empty where the window is the level's whole grid. So the sampler filters a
// block like a separate texture with repeat addressing.
//
//      wrapped coordinates   7 | 0 1 2 3 4 5 6 7 | 0
#ifndef VOXRAY_RADIANCE_CLIPMAP_TEXTURES_GLSL
#define VOXRAY_RADIANCE_CLIPMAP_TEXTURES_GLSL

layout(scalar) readonly buffer RadianceVoxels {
    RadianceGrid grid;
    uint windowSize;
    uint firstWhole;
    ClipmapWindow window[RADIANCE_CLIPMAP_LEVELS];
    uvec3 extent;                          // Texels of the texture.
    uvec3 block[RADIANCE_CLIPMAP_LEVELS];  // By level: texel of wrapped coordinates 0 in its first face.
} radianceVoxels;

uniform sampler3D radianceTexture;
layout(rgba16f) uniform writeonly image3D radianceTarget;

#define RADIANCE_INDEX ivec4  // Wrapped coordinates, and the level.
ivec4 radianceIndex(uint level, ivec3 voxel) { return ivec4(voxel & int(radianceVoxels.windowSize - 1u), level); }

// Texel of wrapped coordinates 0 of a face.
ivec3 blockOf(uint level, uint face) {
    return ivec3(radianceVoxels.block[level] + uvec3(face * (radianceVoxels.window[level].size.x + 2u), 0u, 0u));
}

// A value as stored: in units of the grid's radiance, clamped to the range of half floats.
vec4 halfFloats(vec4 value) {
    const vec4 number = min(vec4(value.rgb / radianceVoxels.grid.unit, value.a), vec4(65504.0));
    return vec4(unpackHalf2x16(packHalf2x16(number.rg)), unpackHalf2x16(packHalf2x16(number.ba)));
}
vec4 inUnits(vec4 number) { return vec4(radianceVoxels.grid.unit * number.rgb, number.a); }

vec4 radianceValue(ivec4 index, uint face) {
    return inUnits(texelFetch(radianceTexture, blockOf(index.w, face) + index.xyz, 0));
}

vec4 quantizedRadiance(vec4 value) { return inUnits(halfFloats(value)); }

void storeRadiance(ivec4 index, uint face, vec4 value) {
    const ivec3 texel = blockOf(index.w, face) + index.xyz;
    const vec4 number = halfFloats(value);

    // Texels at a block's end are copied to the border at the opposite end
    const ivec3 windowSize = ivec3(radianceVoxels.windowSize);
    const ivec3 wraps = ivec3(equal(ivec3(radianceVoxels.window[index.w].size), windowSize));
    const ivec3 end = ivec3(equal(index.xyz, ivec3(0))) - ivec3(equal(index.xyz, windowSize - 1));
    const ivec3 copies = abs(end) * wraps;
    for (int z = 0; z <= copies.z; ++z)
        for (int y = 0; y <= copies.y; ++y)
            for (int x = 0; x <= copies.x; ++x)
                imageStore(radianceTarget, texel + ivec3(x, y, z) * end * windowSize, number);
}

// Values outside of the window are 0: coordinates there are clamped to it, and weighted as linear interpolation with 0
// does.
vec4 filteredFace(uint level, vec3 coordinates, uint face) {
    const ClipmapWindow w = radianceVoxels.window[level];
    const vec3 nearest = clamp(coordinates, vec3(w.first), vec3(w.first + ivec3(w.size) - 1));
    const vec3 weight = max(1.0 - abs(coordinates - nearest), 0.0);
    const vec3 texel = vec3(blockOf(level, face)) + mod(nearest, float(radianceVoxels.windowSize)) + 0.5;
    return weight.x * weight.y * weight.z * textureLod(radianceTexture, texel / vec3(radianceVoxels.extent), 0.0);
}

#include "passes/cones/radiance/radiance_filtered_faces.glsl"

vec4 sampleWindow(uint level, vec3 position, vec3 direction) { return filteredFaces(level, position, direction); }

#endif
