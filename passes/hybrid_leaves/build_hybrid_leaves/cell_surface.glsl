// The surface of a triangle's fragment in a cell.
#ifndef VOXRAY_CELL_SURFACE_GLSL
#define VOXRAY_CELL_SURFACE_GLSL

#include "passes/hybrid_leaves/build_hybrid_leaves/voxelize_in_leaf.glsl"
#include "passes/common/voxel_builder/fragment_material.glsl"
#include "passes/hybrid_leaves/grid_cell.glsl"

struct CellSurface {
    uint cellIndex;  // Among occupied cells.
    float area;      // In cell faces.
    vec3 point;      // Centroid from the cell's center, in cells.
    FragmentMaterial material;
    float emissionLevel;  // Mip level of the emissive texture.
};

// A point in the voxelizer's permuted coordinates, from the center of a triangle's cell, in cells.
vec3 fromCellCenter(TriangleFragment cell, vec3 permuted) {
    const uint axis = cell.permutedTriangle.axis;
    const vec3 p = permuted - (vec3(cell.permutedVoxel) + 0.5);
    return axis == 0u ? p.zxy : axis == 1u ? p.yzx : p;
}

// False if the alpha mask removes it. Area and centroid as in clipFragment(). Sub-samples, which dominate the cost, are
// computed for masked triangles only.
bool cellSurface(TriangleFragment cell, out CellSurface s) {
    s.cellIndex = gridCellIndex(gridBit(gridLevel(cellGrid, 0u), cell.voxel));
    if (s.cellIndex == NO_CELL) return false;
    const GridTriangle t = cell.permutedTriangle;
    vec2 center;
    s.area = clippedArea(t, cell.permutedVoxel, center);
    if (isAlphaMasked(cell)) {
        const uint samples = dominantAxisSubSamples(t, cell.permutedVoxel), opaque = opaqueSubSamples(cell, samples);
        if (opaque == 0u) return false;
        if (samples != 0u) s.area *= float(bitCount(opaque)) / float(bitCount(samples));
    }
    ClippedFragment c;
    c.center = barycentricsAt(t, center);
    c.texCoordWidth = t.texCoordWidth;
    s.material = fragmentMaterial(cell, c);
    s.emissionLevel = footprintLevel(sceneMaterials.data[s.material.point.material].emissiveTexture, c.texCoordWidth);
    const vec3 surfaceCentroid = t.p0 + c.center.x * (t.p1 - t.p0) + c.center.y * (t.p2 - t.p0);
    s.point = clamp(fromCellCenter(cell, surfaceCentroid), -0.5, 0.5);
    return true;
}

#endif
