// Radiance voxels in full grids as in radiance_dense.glsl, but in one 3D texture that the device's sampler filters (layout:
// textures). Each mip level holds a level of voxels. The faces stand side by side along one axis:
//
//      | +x | -x | +y | -y | +z | -z |     each `extent` texels long, of which the grid's voxels are the first
#ifndef VOXRAY_RADIANCE_TEXTURES_GLSL
#define VOXRAY_RADIANCE_TEXTURES_GLSL

#include "passes/cones/radiance/radiance_textures_types.h"

layout(scalar) readonly buffer RadianceVoxels {
    RadianceGrid grid;
    TextureLayout layout_;
} radianceVoxels;

uniform sampler3D radianceTexture;
layout(rgba16f) uniform writeonly image3D radianceTarget;  // The mip level that a shader fills.

// Texels of one face in a mip level.
uvec3 faceExtent(uint level) { return max(radianceVoxels.layout_.extent >> level, 1u); }

// What the shaders that fill levels know a level by, and a voxel's place: the voxel and its level.
#define RADIANCE_LEVEL uint
uint radianceLevel(uint level) { return level; }
ivec4 radianceIndex(uint level, ivec3 voxel) { return ivec4(voxel, level); }

ivec3 texelOf(ivec4 place, uint face) {
    return place.xyz + ivec3(face * faceExtent(uint(place.w)) * radianceVoxels.layout_.along);
}

// `face`: 0 to 5 for +x -x +y -y +z -z, 0 with one value for all.
vec4 radianceValue(ivec4 place, uint face) { return texelFetch(radianceTexture, texelOf(place, face), place.w); }

// Bounded to what half floats hold: 65504 units of radiance.
void storeRadiance(ivec4 place, uint face, vec4 value) {
    imageStore(radianceTarget, texelOf(place, face), min(value, vec4(65504.0)));
}

// One face at a place in voxels of a level, filtered. Outside of the grid is nothing: a place there reads the nearest one in the grid,
// and counts as far as linear interpolation with nothing lets it, so that no face reads its neighbour in the texture.
vec4 filteredFace(uint level, vec3 place, uint face) {
    const vec3 inGrid = clamp(place, vec3(0.0), vec3(levelResolution(radianceVoxels.grid, level) - 1u));
    const vec3 part = max(1.0 - abs(place - inGrid), 0.0);
    const uvec3 extent = faceExtent(level), along = radianceVoxels.layout_.along;
    const vec3 texel = inGrid + 0.5 + vec3(face * extent * along);
    const vec3 size = vec3(extent + (radianceVoxels.grid.directions - 1u) * extent * along);
    return part.x * part.y * part.z * textureLod(radianceTexture, texel / size, float(level));
}

#include "passes/cones/radiance/radiance_filtered_faces.glsl"

vec4 sampleLevel(uint level, vec3 position, vec3 direction) { return filteredFaces(level, position, direction); }

uint startLevel(vec3 position, float dither) { return 0u; }

#endif
