#version 460
#extension GL_GOOGLE_include_directive : require
// Turns the sums of each cell into averages weighted by area. A thread takes a cell.
#include "passes/build_hybrid_leaves/cell_sums.h"
#include "shaders/compute/linear_index.glsl"
#include "shaders/hybrid_leaves/grid_cell.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer CellSumsAt { LargeUints cellSums; };
layout(push_constant) uniform Push {
    uint cells;
} push;

float signedSum(uint at) { return float(int(cellSums.data[at])); }
vec3 signedSums(uint at) { return vec3(signedSum(at), signedSum(at + 1u), signedSum(at + 2u)); }

void main() {
    const uint cell = linearIndex();
    if (cell >= push.cells) return;
    const bool isBright = hybridLeaves.shape.cellWords == BRIGHT_CELL_WORDS;
    const uint at = cell * (isBright ? BRIGHT_SUM_UINTS : SUM_UINTS);
    const float area = max(signedSum(at + SUM_AREA), 1.0);
    const vec3 sum = signedSums(at + SUM_NORMAL);
    const vec3 normal = dot(sum, sum) > 0.0 ? normalize(sum) : vec3(0.0, 0.0, 1.0);
    storeGridCell(cell, GridCell(normal, dot(normal, signedSums(at + SUM_POINT) / area), signedSums(at + SUM_ALBEDO) / area, 0.0));
    if (!isBright) return;
    const vec3 emitted = signedSums(at + SUM_EMISSION);
    const bool bothSides = 2.0 * signedSum(at + SUM_BOTH_SIDES) > max(emitted.r, max(emitted.g, emitted.b));
    storeBrightCell(cell, BrightCell(emitted / area * hybridLeaves.shape.largestEmission, bothSides, signedSums(at + SUM_F0) / area,
                                   signedSum(at + SUM_F90) / area, signedSum(at + SUM_ROUGHNESS) / area));
}
