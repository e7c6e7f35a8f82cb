// What dominant_axis and exact do with a triangle and a voxel that it meets. The including shader says how it measures a piece.
#ifndef VOXRAY_VISIT_GLSL
#define VOXRAY_VISIT_GLSL

#include "passes/voxelize/sub_samples.glsl"
#include "passes/voxelize/voxel_sums.glsl"

#ifndef MARK
// Area in voxel faces of the triangle's piece in a voxel, and its middle over x and y. `own`: its sub-samples along z.
float measurePiece(GridTriangle t, ivec3 voxel, uint own, out vec2 middle);
#endif

void visit(VoxelGrid g, GridTriangle t, ivec3 voxel, float emissionScale) {
    // Where a window or a region ends, triangles go on.
#ifdef MARK
    if (!insideGrid(g, unturned(voxel, t.axis))) return;
#else
    const uint number = voxelNumber(g, unturned(voxel, t.axis));
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
    markVoxel(g, unturned(voxel, t.axis));
#else
    vec2 middle;
    uvec3 covered = allSubSamples(t, voxel);
    float area = measurePiece(t, voxel, covered[t.axis], middle);
    if (masked) {
        if (own != 0u) area *= float(bitCount(left)) / float(bitCount(own));
        covered = uvec3(0u);
        covered[t.axis] = left & own;
    }
    const SurfacePoint s = surfacePoint(t.index, barycentricsAt(t, middle));
    addSurface(number, area, s, t.texCoordWidth, covered, emissionScale);
#endif
}

#endif
