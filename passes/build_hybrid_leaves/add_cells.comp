#version 460
#extension GL_GOOGLE_include_directive : require
// A walk's visitor: adds the material of each clipped fragment to the sums of its cell, weighted by area, in fixed point, so that the
// order of additions does not matter. walk.visitorScale: units of area for a cell's face.
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

void visitCell(TriangleFragment cell, uint grid) {
    const uint number = gridCellNumber(gridBit(grid, cell.voxel));
    ClippedFragment c;
    if (number == NO_CELL || !clipFragment(cell, c)) return;
    const FragmentMaterial m = fragmentMaterial(cell, c);

    // A fragment counts as at least a thousandth of a face, so that the mean of every cell has enough digits.
    const uint at = number * SUM_UINTS;
    const float units = max(round(max(c.area, 1.0 / 1024.0) * walk.visitorScale), 1.0);
    add(at + SUM_AREA, units);
    addVector(at + SUM_NORMAL, m.normal * units);
    addVector(at + SUM_POINT, meanPoint(cell, c.center) * units);
    addVector(at + SUM_ALBEDO, m.albedo * units);
    add(at + SUM_METALLIC, m.metallic * units);
    add(at + SUM_ROUGHNESS, m.roughness * units);
    const uvec3 subSamples = subSamplesByAxis(cell, c);
    for (uint axis = 0u; axis < 3u; ++axis)
        if (subSamples[axis] != 0u) atomicOr(cellSums.data[at + SUB_SAMPLES + axis], subSamples[axis]);
}

void visitFragment(TriangleFragment f) { visitCells(f); }
