// What every method of voxelization writes: with MARK occupancy bits; without, sums of what surfaces carry, in fixed point,
// so that the order of additions does not matter.
#ifndef VOXRAY_VOXEL_SUMS_GLSL
#define VOXRAY_VOXEL_SUMS_GLSL

#include "shaders/scene.glsl"
#include "shaders/voxels.glsl"

#ifdef MARK

layout(set = 0, binding = 16) buffer Occupancy { uint words[]; } occupancy;

void markVoxel(VoxelGrid g, ivec3 voxel) {
    const uint word = voxelWord(g, voxel);
    const uint bit = 1u << (uint(voxel.x) & 31u);
    if ((occupancy.words[word] & bit) == 0u) atomicOr(occupancy.words[word], bit);
}

#else

#include "passes/voxelize/sums_layout.h"
layout(set = 0, binding = 16) buffer Sums { uint data[]; } sums;

void addVector(uint at, vec3 value, float units) {
    for (int k = 0; k < 3; ++k) atomicAdd(sums.data[at + uint(k)], uint(int(round(value[k] * units))));
}

// log2 of a voxel's width in the texture coordinates 0 and 1 of a triangle, the mean of both directions.
vec2 footprint(VoxelGrid g, uint triangle) {
    const uvec3 v = triangleVertices(triangle);
    const vec3 p0 = vertexPosition(v.x);
    const vec3 cross_ = cross(vertexPosition(v.y) - p0, vertexPosition(v.z) - p0);
    const vec4 uv0 = sceneAttributes.data[v.x].texCoords;
    const vec4 a = sceneAttributes.data[v.y].texCoords - uv0, b = sceneAttributes.data[v.z].texCoords - uv0;
    const vec2 uvArea = abs(vec2(a.x * b.y - a.y * b.x, a.z * b.w - a.w * b.z));
    return 0.5 * log2(max(uvArea / max(length(cross_), 1.0e-30), 1.0e-30)) + log2(g.voxelSize);
}

// Mip level whose texels are as wide as a voxel.
float footprintLevel(GpuTextureRef ref, vec2 footprint_) {
    if (ref.texture == NO_TEXTURE) return 0.0;
    const ivec2 size = textureSize(sceneTextures[nonuniformEXT(ref.texture)], 0);
    const float texels = abs(ref.rowU.x * ref.rowV.y - ref.rowU.y * ref.rowV.x) * float(size.x) * float(size.y);
    return max((ref.texCoord == 0u ? footprint_.x : footprint_.y) + 0.5 * log2(max(texels, 1.0e-30)), 0.0);
}

// Adds `area` voxel faces of a surface to a voxel, with the material of one of its points. They count as at least one unit, so
// that every occupied voxel has a material. `covered`: sub-samples of the voxel's faces across x, y and z.
void addSurface(VoxelGrid g, ivec3 voxel, float area, uint triangle, SurfacePoint s, uvec3 covered, float emissionScale) {
    const uint number = voxelNumber(g, voxel);
    if (number == NO_VOXEL) return;
    const GpuMaterial m = sceneMaterials.data[s.material];
    const vec2 width = footprint(g, triangle);
    const float colorLevel = footprintLevel(m.baseColorTexture, width);
    const vec2 metallicRoughness =
        vec2(m.metallic, m.roughness) *
        lookup(m.metallicRoughnessTexture, s.texCoords, footprintLevel(m.metallicRoughnessTexture, width)).bg;
    const vec3 albedo = baseColor(m, s, colorLevel).rgb * (1.0 - metallicRoughness.x);
    const vec3 normal = shadingNormal(m, s, footprintLevel(m.normalTexture, width));

    const uint at = number * SUMS_PER_VOXEL;
    const float units = max(round(area * UNITS_PER_FACE), 1.0);
    atomicAdd(sums.data[at + SUM_AREA], uint(units));
    addVector(at + SUM_AXIS_AREA, s.geometricNormal * s.geometricNormal, units);
    addVector(at + SUM_NORMAL, normal, units);
    addVector(at + SUM_ALBEDO, albedo, units);
    if (emissionScale > 0.0)
        addVector(at + SUM_EMISSION, emission(m, s, footprintLevel(m.emissiveTexture, width)) * emissionScale, units);
    atomicAdd(sums.data[at + SUM_METALLIC], uint(round(metallicRoughness.x * units)));
    atomicAdd(sums.data[at + SUM_ROUGHNESS], uint(round(metallicRoughness.y * units)));
    for (uint axis = 0u; axis < 3u; ++axis)
        if (covered[axis] != 0u) atomicOr(sums.data[at + SUM_COVERED + axis], covered[axis]);
}

#endif

#endif
