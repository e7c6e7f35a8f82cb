// What dominant_axis and exact do with a triangle and a voxel that it meets. The including shader says how it measures a piece.
#ifndef VOXRAY_VISIT_GLSL
#define VOXRAY_VISIT_GLSL

#include "passes/voxelize/sub_samples.glsl"
#ifdef LIGHT
#include "passes/voxelize/voxel_light.glsl"
#else
#include "passes/voxelize/voxel_sums.glsl"
#endif

#ifndef MARK
// Area in voxel faces of the triangle's piece in a voxel, and its middle over x and y. `own`: its sub-samples along z.
float measurePiece(GridTriangle t, ivec3 voxel, uint own, out vec2 middle);
#endif

// `scale`: of emission, as addSurface() takes it; with LIGHT fixed-point units for each watt.
void visit(VoxelGrid g, GridTriangle t, ivec3 voxel, float scale) {
    // Where a window or a region ends, triangles go on.
    const ivec3 cell = unturned(voxel, t.axis);
#ifdef MARK
    if (!insideGrid(g, cell)) return;
#else
    const uint number = voxelNumber(g, cell);
    if (number == NO_VOXEL) return;
#endif
    const GpuMaterial m = sceneMaterials.data[sceneTriangleMaterials.data[t.index]];
    const bool masked = m.alphaMode == ALPHA_MASK;

    // An alpha mask is read at the sub-samples along z: where there are none, at the middle of the column, moved into the
    // triangle. What it cuts away entirely is not there.
    uint own = 0u, left = 0u;
    if (masked) {
        own = ownSubSamples(t, voxel);
        left = alphaLeaves(t, m, voxel, own == 0u ? MIDDLE : own);
        if (left == 0u) return;
    }
#ifdef MARK
    markVoxel(g, cell);
#else
    vec2 middle;
#ifdef LIGHT
    uvec3 covered = uvec3(0u);
    covered[t.axis] = masked ? own : ownSubSamples(t, voxel);
#else
    uvec3 covered = allSubSamples(t, voxel);
#endif
    float area = measurePiece(t, voxel, covered[t.axis], middle);
    if (masked) {
        if (own != 0u) area *= float(bitCount(left)) / float(bitCount(own));
        covered = uvec3(0u);
        covered[t.axis] = left & own;
    }
#ifdef LIGHT
    addLight(g, number, t, voxel, area, covered[t.axis], middle, scale);
#else
    const SurfacePoint s = surfacePoint(t.index, barycentricsAt(t, middle));
    addSurface(number, area, s, t.texCoordWidth, covered, scale);
#endif
#endif
}

#endif
