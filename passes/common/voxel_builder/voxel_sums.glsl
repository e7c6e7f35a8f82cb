// What every method of voxelization writes: with MARK occupancy bits; without, sums of what surfaces carry, in fixed point,
// so that the order of additions does not matter.
#ifndef VOXRAY_VOXEL_SUMS_GLSL
#define VOXRAY_VOXEL_SUMS_GLSL

#include "shaders/scene/scene.glsl"
#include "shaders/voxels/voxels.glsl"

#ifdef MARK

layout(set = 0, binding = 16) buffer Occupancy { uint words[]; } occupancy;

void markVoxel(VoxelGrid g, ivec3 voxel) {
    const uint word = voxelWord(g, voxel);
    const uint bit = voxelBit(g, voxel);
    if ((occupancy.words[word] & bit) == 0u) atomicOr(occupancy.words[word], bit);
}

#else

#include "passes/common/voxel_builder/sums_layout.h"
layout(set = 0, binding = 16, scalar) readonly buffer SumsAt { LargeUints sums; };

void add(uint at, float units) {
    const int rounded = int(round(units));
    if (rounded != 0) atomicAdd(sums.data[at], uint(rounded));
}

void addVector(uint at, vec3 units) {
    for (uint k = 0u; k < 3u; ++k) add(at + k, units[k]);
}

// Mip level whose texels are as wide as a voxel.
float footprintLevel(GpuTextureRef ref, vec2 texCoordWidth_) {
    if (ref.texture == NO_TEXTURE) return 0.0;
    const ivec2 size = textureSize(sceneTextures[nonuniformEXT(ref.texture)], 0);
    const float texels = abs(ref.rowU.x * ref.rowV.y - ref.rowU.y * ref.rowV.x) * float(size.x) * float(size.y);
    return max((ref.texCoord == 0u ? texCoordWidth_.x : texCoordWidth_.y) + 0.5 * log2(max(texels, 1.0e-30)), 0.0);
}

// Adds `area` voxel faces of a surface to a voxel, with the material of one of its points. They count as at least one unit, so
// that every occupied voxel has a material. `width`: of a voxel, as texCoordWidth gives it. `covered`: sub-samples of the voxel's faces across x, y and z.
void addSurface(uint number, float area, SurfacePoint s, vec2 width, uvec3 covered, float emissionScale) {
    const GpuMaterial m = sceneMaterials.data[s.material];
    const float colorLevel = footprintLevel(m.baseColorTexture, width);
    const vec2 metallicRoughness =
        vec2(m.metallic, m.roughness) *
        lookup(m.metallicRoughnessTexture, s.texCoords, footprintLevel(m.metallicRoughnessTexture, width)).bg;
    const vec3 albedo = baseColor(m, s, colorLevel).rgb * (1.0 - metallicRoughness.x);
    const vec3 normal = shadingNormal(m, s, footprintLevel(m.normalTexture, width));

    const uint at = number * SUMS_PER_VOXEL;
    const float units = max(round(area * UNITS_PER_FACE), 1.0);
    add(at + SUM_AREA, units);
    addVector(at + SUM_AXIS_AREA, s.geometricNormal * s.geometricNormal * units);
    addVector(at + SUM_NORMAL, normal * units);
    addVector(at + SUM_ALBEDO, albedo * units);
    if (emissionScale > 0.0)
        addVector(at + SUM_EMISSION, emission(m, s, footprintLevel(m.emissiveTexture, width)) * (emissionScale * units));
    add(at + SUM_METALLIC, metallicRoughness.x * units);
    add(at + SUM_ROUGHNESS, metallicRoughness.y * units);
    for (uint axis = 0u; axis < 3u; ++axis)
        if (covered[axis] != 0u) atomicOr(sums.data[at + SUM_COVERED + axis], covered[axis]);
}

#endif

#endif
