#version 460
#extension GL_GOOGLE_include_directive : require
// The material of each clipped fragment becomes its cell's, whichever comes last (Seok 2021, section 3.2: "a simple write operation",
// which flickers).
#include "passes/build_hybrid_leaves/cell_surface.glsl"

void visitFragment(TriangleFragment cell) {
    CellSurface s;
    if (!cellSurface(cell, s)) return;
    storeGridCell(s.number, GridCell(s.material.normal, dot(s.material.normal, s.point), s.material.albedo, 0.0));
}
