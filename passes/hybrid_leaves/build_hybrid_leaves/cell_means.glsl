// What is summed of a cell's surfaces (cell_sums.h), and the averages that it becomes.
#ifndef VOXRAY_CELL_MEANS_GLSL
#define VOXRAY_CELL_MEANS_GLSL

#include "passes/hybrid_leaves/build_hybrid_leaves/cell_sums.h"
#include "passes/hybrid_leaves/grid_cell.glsl"

layout(scalar) readonly buffer CellSumsAt { LargeUints cellSums; };

struct CellSums {
    float area;
    vec3 normal, point, albedo;
    vec3 emission, f0;
    float bothSides, f90, roughness;
};

float signedSum(uint at) { return float(int(cellSums.data[at])); }
vec3 signedSums(uint at) { return vec3(signedSum(at), signedSum(at + 1u), signedSum(at + 2u)); }

// Of a cell of a finest level.
CellSums cellSumsOf(uint cell) {
    const bool isBright = hybridLeaves.shape.cellWords == BRIGHT_CELL_WORDS;
    const uint at = cell * (isBright ? BRIGHT_SUM_UINTS : SUM_UINTS);
    CellSums s = CellSums(signedSum(at + SUM_AREA), signedSums(at + SUM_NORMAL), signedSums(at + SUM_POINT), signedSums(at + SUM_ALBEDO),
                          vec3(0.0), vec3(0.0), 0.0, 0.0, 0.0);
    if (!isBright) return s;
    s.emission = signedSums(at + SUM_EMISSION);
    s.f0 = signedSums(at + SUM_F0);
    s.bothSides = signedSum(at + SUM_BOTH_SIDES);
    s.f90 = signedSum(at + SUM_F90);
    s.roughness = signedSum(at + SUM_ROUGHNESS);
    return s;
}

// Adds the sums of a finer cell. `center`: its center from that of the cell, in the cell's edges; `scale`: its edge in these.
void addSums(inout CellSums s, CellSums finer, vec3 center, float scale) {
    s.area += finer.area;
    s.normal += finer.normal;
    s.point += finer.area * center + scale * finer.point;
    s.albedo += finer.albedo;
    s.emission += finer.emission;
    s.f0 += finer.f0;
    s.bothSides += finer.bothSides;
    s.f90 += finer.f90;
    s.roughness += finer.roughness;
}

// Averages weighted by area become the cell's content.
void storeMeans(uint cell, CellSums s) {
    const float area = max(s.area, 1.0);
    const vec3 normal = dot(s.normal, s.normal) > 0.0 ? normalize(s.normal) : vec3(0.0, 0.0, 1.0);
    storeGridCell(cell, GridCell(normal, dot(normal, s.point / area), s.albedo / area, 0.0));
    if (hybridLeaves.shape.cellWords != BRIGHT_CELL_WORDS) return;
    const bool bothSides = 2.0 * s.bothSides > max(s.emission.r, max(s.emission.g, s.emission.b));
    storeBrightCell(cell, BrightCell(s.emission / area * hybridLeaves.shape.largestEmission, bothSides, s.f0 / area, s.f90 / area,
                                     s.roughness / area));
}

#endif
