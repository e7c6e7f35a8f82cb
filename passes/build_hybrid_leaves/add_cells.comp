#version 460
#extension GL_GOOGLE_include_directive : require
// Adds the material of each clipped fragment to the sums of its cell, weighted by area, in fixed point, so that the order of additions
// does not matter. walk.visitorScale: units of area for a cell's face.
#include "passes/build_hybrid_leaves/cell_sums.h"
#include "passes/build_hybrid_leaves/cell_surface.glsl"

layout(scalar) readonly buffer CellSumsAt { LargeUints cellSums; };

void add(uint at, float units) {
    const int rounded = int(round(units));
    if (rounded != 0) atomicAdd(cellSums.data[at], uint(rounded));
}

void addVector(uint at, vec3 units) {
    for (uint k = 0u; k < 3u; ++k) add(at + k, units[k]);
}

void visitFragment(TriangleFragment cell) {
    CellSurface s;
    if (!cellSurface(cell, s)) return;

    // A fragment counts as at least a thousandth of a face, so that the mean of every cell has enough digits.
    const uint at = s.number * SUM_UINTS;
    const float units = max(round(max(s.area, 1.0 / 1024.0) * walk.visitorScale), 1.0);
    add(at + SUM_AREA, units);
    addVector(at + SUM_NORMAL, s.material.normal * units);
    addVector(at + SUM_POINT, s.point * units);
    addVector(at + SUM_ALBEDO, s.material.albedo * units);
}
