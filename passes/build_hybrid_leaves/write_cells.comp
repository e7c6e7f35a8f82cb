#version 460
#extension GL_GOOGLE_include_directive : require
// A walk's visitor: the material of each clipped fragment becomes its cell's, whichever comes last (Seok 2021, section 3.2: "a simple
// write operation", which flickers).
#include "passes/build_hybrid_leaves/cell_surface.glsl"

void visitCell(TriangleFragment cell, uint grid) {
    const uint number = gridCellNumber(gridBit(grid, cell.voxel));
    ClippedFragment c;
    if (number == NO_CELL || !clipFragment(cell, c)) return;
    const FragmentMaterial m = fragmentMaterial(cell, c);
    const uvec3 subSamples = subSamplesByAxis(cell, c);
    const int met = max(bitCount(subSamples.x), max(bitCount(subSamples.y), bitCount(subSamples.z)));
    storeGridCell(number, GridCell(m.normal, dot(m.normal, meanPoint(cell, c.center)), m.albedo, float(met) / 16.0, m.metallic,
                                   m.roughness));
}

void visitFragment(TriangleFragment f) { visitCells(f); }
