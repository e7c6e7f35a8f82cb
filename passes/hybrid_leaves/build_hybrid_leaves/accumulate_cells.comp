// Accumulates the materials of clipped fragments in their cells, weighted by area. Fixed point: the order of additions
// does not matter. voxelizer.fixedPointScale: units of area per cell face.
#include "passes/hybrid_leaves/build_hybrid_leaves/cell_sums.h"
#include "passes/hybrid_leaves/build_hybrid_leaves/cell_surface.glsl"
#include "shaders/scene/specular.glsl"

layout(scalar) readonly buffer CellSumsRef { LargeUints cellSums; };

void addFixed(uint word, float units) {
    const int rounded = int(round(units));
    if (rounded != 0) atomicAdd(cellSums.data[word], uint(rounded));
}

void addVector(uint word, vec3 units) {
    for (uint k = 0u; k < 3u; ++k) addFixed(word + k, units[k]);
}

void addExtended(uint word, FragmentMaterial f, float emissionLevel, float units) {
    const GpuMaterial m = sceneMaterials.data[f.point.material];
    const vec3 emitted = emission(m, f.point, emissionLevel) / max(hybridLeaves.shape.largestEmission, 1e-20) * units;
    const Specular s = makeSpecular(f.base, f.metallic, f.roughness, m.specular, m.specularColor, m.ior);
    addVector(word + SUM_EMISSION, emitted);
    if (m.doubleSided != 0u) addFixed(word + SUM_EMISSION_BOTH_SIDES, max(emitted.r, max(emitted.g, emitted.b)));
    addVector(word + SUM_F0, s.f0 * units);
    addFixed(word + SUM_F90, s.f90 * units);
    addFixed(word + SUM_ROUGHNESS, s.roughness * units);
}

void processFragment(TriangleFragment cell) {
    CellSurface s;
    if (!cellSurface(cell, s)) return;

    // At least a thousandth of a face each, so that every cell's mean has enough digits
    const bool isExtended = hybridLeaves.shape.cellWords == EXTENDED_CELL_WORDS;
    const uint word = s.cellIndex * (isExtended ? EXTENDED_SUM_UINTS : SUM_UINTS);
    const float units = max(round(max(s.area, 1.0 / 1024.0) * voxelizer.fixedPointScale), 1.0);
    addFixed(word + SUM_AREA, units);
    addVector(word + SUM_NORMAL, s.material.normal * units);
    addVector(word + SUM_POINT, s.point * units);
    addVector(word + SUM_ALBEDO, s.material.albedo * units);
    if (isExtended) addExtended(word, s.material, s.emissionLevel, units);
}
