// What dominant_axis and exact do with a triangle and a voxel that it meets. The including shader says how it measures a piece.
#ifndef VOXRAY_VISIT_GLSL
#define VOXRAY_VISIT_GLSL

#include "passes/common/triangle_walk/sub_samples.glsl"
#ifdef LIGHT
#include "passes/light_clipmap/voxel_light.glsl"
#else
#include "passes/common/voxel_builder/voxel_sums.glsl"
#endif

#ifndef MARK
// Area in voxel faces of the triangle's piece in a voxel, and its center over x and y. `own`: its sub-samples along z.
float measureFragment(GridTriangle t, ivec3 voxel, uint own, out vec2 center);
#endif

// `scale`: of emission, as addSurface() takes it; with LIGHT fixed-point units for each watt.
void visit(VoxelGrid g, GridTriangle t, ivec3 voxel, float scale) {
    // Where a window or a region ends, triangles go on.
    const ivec3 cell = unpermuted(voxel, t.axis);
#ifdef MARK
    if (!insideGrid(g, cell)) return;
#else
    const uint number = voxelNumber(g, cell);
    if (number == NO_VOXEL) return;
#endif
    const GpuMaterial m = sceneMaterials.data[sceneTriangleMaterials.data[t.index]];
    const bool masked = m.alphaMode == ALPHA_MASK;

    // An alpha mask is read at the sub-samples along z: where there are none, at the center of the column, moved into the
    // triangle. What it cuts away entirely is not there.
    uint own = 0u, left = 0u;
    if (masked) {
        own = ownSubSamples(t, voxel);
        left = alphaLeaves(t, m, voxel, own == 0u ? CENTER : own);
        if (left == 0u) return;
    }
#ifdef MARK
    markVoxel(g, cell);
#else
    vec2 center;
#ifdef LIGHT
    uvec3 covered = uvec3(0u);
    covered[t.axis] = masked ? own : ownSubSamples(t, voxel);
#else
    uvec3 covered = allSubSamples(t, voxel);
#endif
    float area = measureFragment(t, voxel, covered[t.axis], center);
    if (masked) {
        if (own != 0u) area *= float(bitCount(left)) / float(bitCount(own));
        covered = uvec3(0u);
        covered[t.axis] = left & own;
    }
#ifdef LIGHT
    addLight(g, number, t, voxel, area, covered[t.axis], center, scale);
#else
    const SurfacePoint s = surfacePoint(t.index, barycentricsAt(t, center));
    addSurface(number, area, s, t.texCoordWidth, covered, scale);
#endif
#endif
}

#endif
