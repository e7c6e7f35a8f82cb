// Sums over a cell's surfaces (cell_sums.h), and the means that are stored in the cell.
#ifndef VOXRAY_CELL_MEANS_GLSL
#define VOXRAY_CELL_MEANS_GLSL

#include "passes/hybrid_leaves/build_hybrid_leaves/cell_sums.h"
#include "passes/hybrid_leaves/grid_cell.glsl"

layout(scalar) readonly buffer CellSumsRef { LargeUints cellSums; };

struct CellSums {
    float area;
    vec3 normal, point, albedo;
    vec3 emission, f0;
    float emissionBothSides, f90, roughness;
};

float signedSum(uint word) { return float(int(cellSums.data[word])); }
vec3 signedSums(uint word) { return vec3(signedSum(word), signedSum(word + 1u), signedSum(word + 2u)); }

// Of a cell of level 0.
CellSums loadCellSums(uint cell) {
    const bool isExtended = hybridLeaves.shape.cellWords == EXTENDED_CELL_WORDS;
    const uint word = cell * (isExtended ? EXTENDED_SUM_UINTS : SUM_UINTS);
    CellSums s = CellSums(signedSum(word + SUM_AREA), signedSums(word + SUM_NORMAL), signedSums(word + SUM_POINT),
                          signedSums(word + SUM_ALBEDO), vec3(0.0), vec3(0.0), 0.0, 0.0, 0.0);
    if (!isExtended) return s;
    s.emission = signedSums(word + SUM_EMISSION);
    s.f0 = signedSums(word + SUM_F0);
    s.emissionBothSides = signedSum(word + SUM_EMISSION_BOTH_SIDES);
    s.f90 = signedSum(word + SUM_F90);
    s.roughness = signedSum(word + SUM_ROUGHNESS);
    return s;
}

// Adds the sums of a finer cell. `center`: its center relative to that of the coarse cell; `scale`: its edge; both in
// edges of the coarse cell.
void addSums(inout CellSums s, CellSums finer, vec3 center, float scale) {
    s.area += finer.area;
    s.normal += finer.normal;
    s.point += finer.area * center + scale * finer.point;
    s.albedo += finer.albedo;
    s.emission += finer.emission;
    s.f0 += finer.f0;
    s.emissionBothSides += finer.emissionBothSides;
    s.f90 += finer.f90;
    s.roughness += finer.roughness;
}

// Stores means weighted by area.
void storeMeans(uint cell, CellSums s) {
    const float area = max(s.area, 1.0);
    const vec3 normal = dot(s.normal, s.normal) > 0.0 ? normalize(s.normal) : vec3(0.0, 0.0, 1.0);
    storeGridCell(cell, GridCell(normal, dot(normal, s.point / area), s.albedo / area, 0.0));
    if (hybridLeaves.shape.cellWords != EXTENDED_CELL_WORDS) return;
    const bool emitsBothSides = 2.0 * s.emissionBothSides > max(s.emission.r, max(s.emission.g, s.emission.b));
    storeExtendedCell(cell, ExtendedCell(s.emission / area * hybridLeaves.shape.largestEmission, emitsBothSides,
                                         s.f0 / area, s.f90 / area, s.roughness / area));
}

#endif
