// A visitor's view of a pair of a triangle and a voxel, in the methods exact and dominant_axis.
//
//         o    o    o    o       sub-samples of the voxel's face across z, the axis that the triangle faces most
//      +--:----:----:----:--+
//      |  :    :    :  _.*--|--  triangle
//      |  :    : _.-*'   :  |
//      |  : _.-*'   :    :  |    * a sub-sample's line along z meets the triangle within the voxel: this sub-sample
//      +--:'---:----:----:--+      belongs to the clipped fragment
//      _.-'
//
// The clipped fragment is the part of the triangle in the voxel. Fragments of a surface neither overlap nor leave gaps, and a
// sub-sample's line meets one of them.
//
// A visitor asks for what it needs, since each answer costs more than the one before: f.voxel, passesAlphaMask(),
// clipFragment(), subSamplesByAxis().
#ifndef VOXRAY_CLIPPED_FRAGMENT_GLSL
#define VOXRAY_CLIPPED_FRAGMENT_GLSL

#include "passes/common/triangle_walk/sub_samples.glsl"

struct TriangleFragment {
    uint triangle;
    ivec3 voxel;  // In grid coordinates. May lie outside what the grid holds: triangles go on where a window ends.
    GridTriangle permutedTriangle;
    ivec3 permutedVoxel;
};

struct ClippedFragment {
    float area;          // In units of a voxel's face; 0 where the triangle only touches the voxel.
    vec2 center;         // Centroid, as barycentric coordinates; of a fragment without area a point of the triangle near the voxel.
    uint axis;           // That the triangle faces most.
    uint subSamples;     // Sub-samples of the face across `axis`, without those that an alpha mask cuts away.
    vec2 texCoordWidth;  // log2 of a voxel's width in texture coordinates 0 and 1.
};

// The visitor: defined by the shader that includes a walk.
void visitFragment(TriangleFragment f);

// Area of the clipped triangle in voxel faces, and its center over x and y: each method's own.
float measureFragment(GridTriangle t, ivec3 permutedVoxel, uint subSamples, out vec2 center);

TriangleFragment triangleFragment(GridTriangle t, ivec3 permutedVoxel) {
    return TriangleFragment(t.index, unpermuted(permutedVoxel, t.axis), t, permutedVoxel);
}

bool isAlphaMasked(TriangleFragment f) {
    return sceneMaterials.data[triangleMaterial(f.triangle)].alphaMode == ALPHA_MASK;
}

// Those of the sub-samples that the alpha mask leaves. A fragment without a sub-sample is tested at the point of the triangle that
// is nearest to the center of the column: the result is CENTER or 0.
uint opaqueSubSamples(TriangleFragment f, uint subSamples) {
    const GpuMaterial m = sceneMaterials.data[triangleMaterial(f.triangle)];
    return opaqueSubSamples(f.permutedTriangle, m, f.permutedVoxel, subSamples == 0u ? CENTER : subSamples);
}

// Whether the alpha mask leaves any of the fragment.
bool passesAlphaMask(TriangleFragment f) {
    return !isAlphaMasked(f) || opaqueSubSamples(f, ownSubSamples(f.permutedTriangle, f.permutedVoxel)) != 0u;
}

// Measures the fragment; false where the alpha mask cuts all of it away. An alpha mask scales the area by the fraction of
// sub-samples that it leaves.
bool clipFragment(TriangleFragment f, out ClippedFragment c) {
    const GridTriangle t = f.permutedTriangle;
    const bool masked = isAlphaMasked(f);
    const uint all = ownSubSamples(t, f.permutedVoxel);
    const uint opaque = masked ? opaqueSubSamples(f, all) : all;
    if (masked && opaque == 0u) return false;

    vec2 center;
    c.area = measureFragment(t, f.permutedVoxel, all, center);
    if (masked && all != 0u) c.area *= float(bitCount(opaque)) / float(bitCount(all));
    c.center = barycentricsAt(t, center);
    c.axis = t.axis;
    c.subSamples = opaque & all;
    c.texCoordWidth = t.texCoordWidth;
    return true;
}

// Barycentric coordinates of a sub-sample, by its bit.
vec2 subSampleBarycentrics(TriangleFragment f, int bit) {
    return barycentricsAt(f.permutedTriangle, subSamplePoint(f.permutedVoxel, bit));
}

// Sub-samples of the faces across x, y and z. An alpha mask is tested across one axis alone: the others have none.
uvec3 subSamplesByAxis(TriangleFragment f, ClippedFragment c) {
    uvec3 byAxis = uvec3(0u);
    if (!isAlphaMasked(f)) byAxis = crossSubSamples(f.permutedTriangle, f.permutedVoxel);
    byAxis[c.axis] = c.subSamples;
    return byAxis;
}

#endif
