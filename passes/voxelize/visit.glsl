// What dominant_axis and exact do with a triangle and a voxel that it meets. The including shader says how it measures a piece.
#ifndef VOXRAY_VISIT_GLSL
#define VOXRAY_VISIT_GLSL

#include "passes/voxelize/piece.glsl"
#include "passes/voxelize/voxel_sums.glsl"

#ifndef MARK
// Area in voxel faces of the triangle's piece in a voxel, and its middle over x and y. `own`: its sub-samples along z.
float measurePiece(GridTriangle t, ivec3 voxel, uint own, out vec2 middle);
#endif

void visit(VoxelGrid g, GridTriangle t, ivec3 voxel, float emissionScale) {
    const GpuMaterial m = sceneMaterials.data[sceneTriangleMaterials.data[t.index]];
    const bool masked = m.alphaMode == ALPHA_MASK;
#ifdef MARK
    if (masked && alphaShare(t, m, voxel, ownSubSamples(t, voxel)) == 0.0) return;
    markVoxel(g, unturned(voxel, t.axis));
#else
    const uint own = ownSubSamples(t, voxel);
    vec2 middle;
    float area = measurePiece(t, voxel, own, middle);
    uvec3 covered;
    if (masked) {
        // An alpha mask's coverage is sampled along z alone.
        const float share = alphaShare(t, m, voxel, own);
        if (share == 0.0) return;
        area *= share;
        covered = uvec3(0u);
        covered[t.axis] = alphaLeaves(t, m, voxel, own);
    } else {
        covered = allSubSamples(t, voxel, own);
    }
    const SurfacePoint s = surfacePoint(t.index, barycentricsAt(t, middle));
    addSurface(g, unturned(voxel, t.axis), area, t.index, s, covered, emissionScale);
#endif
}

#endif
