// Fragment callback: adds the material of each clipped fragment to its voxel's accumulator, weighted by area. Fixed
// point: the order of additions does not matter. voxelizer.fixedPointScale: 1 over the scene's largest emission; 0 if
// nothing emits.
#ifndef VOXRAY_ADD_SURFACES_GLSL
#define VOXRAY_ADD_SURFACES_GLSL

#include "passes/common/voxel_builder/fragment_material.glsl"
#include "passes/common/voxel_builder/surface_accumulator.h"
#include "shaders/voxels/voxels.glsl"

layout(scalar) readonly buffer SurfaceAccumulatorRef { LargeUints surfaceAccumulator; };
writeonly buffer Overflow { uint isAny; } overflow;  // Whether a voxel has an area of more than MAX_FACES.

void add(uint word, float units) {
    const int rounded = int(round(units));
    if (rounded != 0) atomicAdd(surfaceAccumulator.data[word], uint(rounded));
}

void addVector(uint word, vec3 units) {
    for (uint k = 0u; k < 3u; ++k) add(word + k, units[k]);
}

void processFragment(TriangleFragment f) {
    const uint voxel = voxelNumber(voxelizer.grid, f.voxel);
    if (voxel == NO_VOXEL) return;
    ClippedFragment c;
    if (!clipFragment(f, c)) return;

    const FragmentMaterial m = fragmentMaterial(f, c);
    const GpuMaterial material = sceneMaterials.data[m.point.material];

    // A fragment has an area of at least one unit, so that every occupied voxel has a material
    const uint first = voxel * ACCUMULATOR_UINTS;
    const float units = max(round(c.area * UNITS_PER_FACE), 1.0);
    const uint before = atomicAdd(surfaceAccumulator.data[first + SUM_AREA], uint(units));
    if (float(before) + units > float(MAX_FACES) * UNITS_PER_FACE) overflow.isAny = 1u;
    addVector(first + SUM_AXIS_AREA, m.point.geometricNormal * m.point.geometricNormal * units);
    addVector(first + SUM_NORMAL, m.normal * units);
    addVector(first + SUM_ALBEDO, m.albedo * units);
    if (voxelizer.fixedPointScale > 0.0)
        addVector(first + SUM_EMISSION,
                  emission(material, m.point, footprintLevel(material.emissiveTexture, c.texCoordWidth)) *
                      (voxelizer.fixedPointScale * units));
    add(first + SUM_METALLIC, m.metallic * units);
    add(first + SUM_ROUGHNESS, m.roughness * units);

    const uvec3 subSamples = subSamplesByAxis(f, c);
    for (uint axis = 0u; axis < 3u; ++axis)
        if (subSamples[axis] != 0u) atomicOr(surfaceAccumulator.data[first + SUB_SAMPLES + axis], subSamples[axis]);
}

#endif
