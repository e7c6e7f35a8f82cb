// Fragment callback: adds the material of each clipped fragment to the accumulator of its voxel, weighted by area, in fixed point, so
// that the order of additions does not matter. voxelizer.fixedPointScale: one over the scene's largest emission; 0 where nothing emits.
#ifndef VOXRAY_ADD_SURFACES_GLSL
#define VOXRAY_ADD_SURFACES_GLSL

#include "passes/common/voxel_builder/fragment_material.glsl"
#include "passes/common/voxel_builder/surface_accumulator.h"
#include "shaders/voxels/voxels.glsl"

layout(scalar) readonly buffer SurfaceAccumulatorRef { LargeUints surfaceAccumulator; };

void add(uint at, float units) {
    const int rounded = int(round(units));
    if (rounded != 0) atomicAdd(surfaceAccumulator.data[at], uint(rounded));
}

void addVector(uint at, vec3 units) {
    for (uint k = 0u; k < 3u; ++k) add(at + k, units[k]);
}

void processFragment(TriangleFragment f) {
    const uint voxel = voxelNumber(voxelizer.grid, f.voxel);
    if (voxel == NO_VOXEL) return;
    ClippedFragment c;
    if (!clipFragment(f, c)) return;

    const FragmentMaterial m = fragmentMaterial(f, c);
    const GpuMaterial material = sceneMaterials.data[m.at.material];

    // A fragment counts as at least one unit of area, so that every occupied voxel has a material.
    const uint at = voxel * ACCUMULATOR_UINTS;
    const float units = max(round(c.area * UNITS_PER_FACE), 1.0);
    add(at + SUM_AREA, units);
    addVector(at + SUM_AXIS_AREA, m.at.geometricNormal * m.at.geometricNormal * units);
    addVector(at + SUM_NORMAL, m.normal * units);
    addVector(at + SUM_ALBEDO, m.albedo * units);
    if (voxelizer.fixedPointScale > 0.0)
        addVector(at + SUM_EMISSION, emission(material, m.at, footprintLevel(material.emissiveTexture, c.texCoordWidth)) *
                                        (voxelizer.fixedPointScale * units));
    add(at + SUM_METALLIC, m.metallic * units);
    add(at + SUM_ROUGHNESS, m.roughness * units);

    const uvec3 subSamples = subSamplesByAxis(f, c);
    for (uint axis = 0u; axis < 3u; ++axis)
        if (subSamples[axis] != 0u) atomicOr(surfaceAccumulator.data[at + SUB_SAMPLES + axis], subSamples[axis]);
}

#endif
