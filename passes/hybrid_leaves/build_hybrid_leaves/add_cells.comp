// Adds the material of each clipped fragment to the sums of its cell, weighted by area, in fixed point, so that the order of additions
// does not matter. walk.visitorScale: units of area for a cell's face.
#include "passes/hybrid_leaves/build_hybrid_leaves/cell_sums.h"
#include "passes/hybrid_leaves/build_hybrid_leaves/cell_surface.glsl"
#include "shaders/scene/specular.glsl"

layout(scalar) readonly buffer CellSumsAt { LargeUints cellSums; };

void add(uint at, float units) {
    const int rounded = int(round(units));
    if (rounded != 0) atomicAdd(cellSums.data[at], uint(rounded));
}

void addVector(uint at, vec3 units) {
    for (uint k = 0u; k < 3u; ++k) add(at + k, units[k]);
}

void addLobes(uint at, FragmentMaterial f, float emissionLevel, float units) {
    const GpuMaterial m = sceneMaterials.data[f.at.material];
    const vec3 emitted = emission(m, f.at, emissionLevel) / max(hybridLeaves.shape.largestEmission, 1e-20) * units;
    const Specular s = makeSpecular(f.base, f.metallic, f.roughness, m.specular, m.specularColor, m.ior);
    addVector(at + SUM_EMISSION, emitted);
    if (m.doubleSided != 0u) add(at + SUM_BOTH_SIDES, max(emitted.r, max(emitted.g, emitted.b)));
    addVector(at + SUM_F0, s.f0 * units);
    add(at + SUM_F90, s.f90 * units);
    add(at + SUM_ROUGHNESS, s.roughness * units);
}

void visitFragment(TriangleFragment cell) {
    CellSurface s;
    if (!cellSurface(cell, s)) return;

    // A fragment counts as at least a thousandth of a face, so that the mean of every cell has enough digits.
    const bool isBright = hybridLeaves.shape.cellWords == BRIGHT_CELL_WORDS;
    const uint at = s.number * (isBright ? BRIGHT_SUM_UINTS : SUM_UINTS);
    const float units = max(round(max(s.area, 1.0 / 1024.0) * walk.visitorScale), 1.0);
    add(at + SUM_AREA, units);
    addVector(at + SUM_NORMAL, s.material.normal * units);
    addVector(at + SUM_POINT, s.point * units);
    addVector(at + SUM_ALBEDO, s.material.albedo * units);
    if (isBright) addLobes(at, s.material, s.emissionLevel, units);
}
