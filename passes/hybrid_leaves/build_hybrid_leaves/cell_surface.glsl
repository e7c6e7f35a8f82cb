// What a triangle's fragment in a cell is made of.
#ifndef VOXRAY_CELL_SURFACE_GLSL
#define VOXRAY_CELL_SURFACE_GLSL

#include "passes/hybrid_leaves/build_hybrid_leaves/grid_cells.glsl"
#include "passes/common/voxel_builder/fragment_material.glsl"
#include "passes/hybrid_leaves/grid_cell.glsl"

struct CellSurface {
    uint number;  // Of the cell, among those that are not empty.
    float area;   // In units of a cell's face.
    vec3 point;   // Centroid from the cell's center, in cells.
    FragmentMaterial material;
    float emissionLevel;  // Mip level of the emissive texture.
};

// A point in the walk's coordinates, whose axes are permuted, from the center of a triangle's cell, in cells.
vec3 fromCellCenter(TriangleFragment cell, vec3 permuted) {
    const uint axis = cell.permutedTriangle.axis;
    const vec3 p = permuted - (vec3(cell.permutedVoxel) + 0.5);
    return axis == 0u ? p.zxy : axis == 1u ? p.yzx : p;
}

// False where the alpha mask cuts all of it away. Area and centroid are as in clipFragment(); sub-samples, which cost most there, are
// taken of masked triangles alone.
bool cellSurface(TriangleFragment cell, out CellSurface s) {
    s.number = gridCellNumber(gridBit(gridLevel(cellGrid, 0u), cell.voxel));
    if (s.number == NO_CELL) return false;
    const GridTriangle t = cell.permutedTriangle;
    vec2 center;
    s.area = clippedArea(t, cell.permutedVoxel, center);
    if (isAlphaMasked(cell)) {
        const uint all = ownSubSamples(t, cell.permutedVoxel), opaque = opaqueSubSamples(cell, all);
        if (opaque == 0u) return false;
        if (all != 0u) s.area *= float(bitCount(opaque)) / float(bitCount(all));
    }
    ClippedFragment c;
    c.center = barycentricsAt(t, center);
    c.texCoordWidth = t.texCoordWidth;
    s.material = fragmentMaterial(cell, c);
    s.emissionLevel = footprintLevel(sceneMaterials.data[s.material.at.material].emissiveTexture, c.texCoordWidth);
    const vec3 point = t.p0 + c.center.x * (t.p1 - t.p0) + c.center.y * (t.p2 - t.p0);
    s.point = clamp(fromCellCenter(cell, point), -0.5, 0.5);
    return true;
}

#endif
