// Radiance voxels in full grids as in radiance_dense.glsl, but in one 3D texture that the sampler filters (layout:
// textures). Each mip level holds a level of voxels. The faces lie side by side along one axis:
//
//      | +x | -x | +y | -y | +z | -z |     each `extent` texels long, of which the grid's voxels are the first
#ifndef VOXRAY_RADIANCE_TEXTURES_GLSL
#define VOXRAY_RADIANCE_TEXTURES_GLSL

layout(scalar) readonly buffer RadianceVoxels {
    RadianceGrid grid;
    TextureLayout layout_;
} radianceVoxels;

uniform sampler3D radianceTexture;
layout(rgba16f) uniform writeonly image3D radianceTarget;  // The mip level that a shader fills.

// Texels of one face in a mip level.
uvec3 faceExtent(uint level) { return max(radianceVoxels.layout_.extent >> level, 1u); }

// Levels and voxels as the shaders that fill levels address them: a voxel is its coordinates and its level.
#define RADIANCE_LEVEL uint
uint radianceLevel(uint level) { return level; }
ivec4 radianceIndex(uint level, ivec3 voxel) { return ivec4(voxel, level); }

ivec3 texelOf(ivec4 voxel, uint face) {
    return voxel.xyz + ivec3(face * faceExtent(uint(voxel.w)) * radianceVoxels.layout_.along);
}

// `face`: 0 to 5 for +x -x +y -y +z -z, 0 with one value for all.
vec4 radianceValue(ivec4 voxel, uint face) { return texelFetch(radianceTexture, texelOf(voxel, face), voxel.w); }

// Clamped to the range of half floats.
void storeRadiance(ivec4 voxel, uint face, vec4 value) {
    imageStore(radianceTarget, texelOf(voxel, face), min(value, vec4(65504.0)));
}

// Values outside of the grid are 0: coordinates there are clamped to it, and weighted as linear interpolation with 0
// does, so that no face reads the next one in the texture.
vec4 filteredFace(uint level, vec3 coordinates, uint face) {
    const vec3 inGrid = clamp(coordinates, vec3(0.0), vec3(levelResolution(radianceVoxels.grid, level) - 1u));
    const vec3 weight = max(1.0 - abs(coordinates - inGrid), 0.0);
    const uvec3 extent = faceExtent(level), along = radianceVoxels.layout_.along;
    const vec3 texel = inGrid + 0.5 + vec3(face * extent * along);
    const vec3 size = vec3(extent + (radianceVoxels.grid.directions - 1u) * extent * along);
    return weight.x * weight.y * weight.z * textureLod(radianceTexture, texel / size, float(level));
}

#include "passes/cones/radiance/radiance_filtered_faces.glsl"

vec4 sampleLevel(uint level, vec3 position, vec3 direction) { return filteredFaces(level, position, direction); }

uint startLevel(vec3 position, float dither) { return 0u; }

#endif
