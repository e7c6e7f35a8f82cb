// A walk's visitor: adds the material of each clipped fragment to the accumulator of its voxel, weighted by area, in fixed point, so
// that the order of additions does not matter. walk.visitorScale: one over the scene's largest emission; 0 where nothing emits.
#ifndef VOXRAY_ADD_SURFACES_GLSL
#define VOXRAY_ADD_SURFACES_GLSL

#include "passes/common/voxel_builder/surface_accumulator.h"
#include "shaders/scene/scene.glsl"
#include "shaders/voxels/voxels.glsl"

layout(scalar) readonly buffer SurfaceAccumulatorAt { LargeUints surfaceAccumulator; };

void add(uint at, float units) {
    const int rounded = int(round(units));
    if (rounded != 0) atomicAdd(surfaceAccumulator.data[at], uint(rounded));
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

void visitFragment(TriangleFragment f) {
    const uint voxel = voxelNumber(walk.grid, f.voxel);
    if (voxel == NO_VOXEL) return;
    ClippedFragment c;
    if (!clipFragment(f, c)) return;

    // The material at the fragment's center.
    const SurfacePoint s = surfacePoint(f.triangle, c.center);
    const GpuMaterial m = sceneMaterials.data[s.material];
    const vec2 width = c.texCoordWidth;
    const vec2 metallicRoughness =
        vec2(m.metallic, m.roughness) *
        lookup(m.metallicRoughnessTexture, s.texCoords, footprintLevel(m.metallicRoughnessTexture, width)).bg;
    const vec3 albedo = baseColor(m, s, footprintLevel(m.baseColorTexture, width)).rgb * (1.0 - metallicRoughness.x);
    const vec3 normal = shadingNormal(m, s, footprintLevel(m.normalTexture, width));

    // A fragment counts as at least one unit of area, so that every occupied voxel has a material.
    const uint at = voxel * ACCUMULATOR_UINTS;
    const float units = max(round(c.area * UNITS_PER_FACE), 1.0);
    add(at + SUM_AREA, units);
    addVector(at + SUM_AXIS_AREA, s.geometricNormal * s.geometricNormal * units);
    addVector(at + SUM_NORMAL, normal * units);
    addVector(at + SUM_ALBEDO, albedo * units);
    if (walk.visitorScale > 0.0)
        addVector(at + SUM_EMISSION, emission(m, s, footprintLevel(m.emissiveTexture, width)) * (walk.visitorScale * units));
    add(at + SUM_METALLIC, metallicRoughness.x * units);
    add(at + SUM_ROUGHNESS, metallicRoughness.y * units);

    const uvec3 subSamples = subSamplesByAxis(f, c);
    for (uint axis = 0u; axis < 3u; ++axis)
        if (subSamples[axis] != 0u) atomicOr(surfaceAccumulator.data[at + SUB_SAMPLES + axis], subSamples[axis]);
}

#endif
