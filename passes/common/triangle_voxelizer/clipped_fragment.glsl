// What a fragment callback is given for a pair of a triangle and a voxel, in the methods exact and dominant_axis.
//
//         o    o    o    o       sub-samples of the voxel's face across z, the triangle's dominant axis
//      +--:----:----:----:--+
//      |  :    :    :  _.*--|--  triangle
//      |  :    : _.-*'   :  |
//      |  : _.-*'   :    :  |    * a sub-sample's line along z hits the triangle within the voxel: this sub-sample
//      +--:'---:----:----:--+      belongs to the clipped fragment
//      _.-'
//
// The clipped fragment is the part of the triangle in the voxel. Fragments of a surface neither overlap nor leave gaps,
// and a sub-sample's line hits one of them.
//
// Callbacks query what they need, by rising cost: f.voxel, passesAlphaMask(), clipFragment(), subSamplesByAxis().
#ifndef VOXRAY_CLIPPED_FRAGMENT_GLSL
#define VOXRAY_CLIPPED_FRAGMENT_GLSL

#include "passes/common/triangle_voxelizer/sub_samples.glsl"

struct TriangleFragment {
    uint triangle;
    ivec3 voxel;  // In grid coordinates; may be outside the grid's window.
    GridTriangle permutedTriangle;
    ivec3 permutedVoxel;
};

struct ClippedFragment {
    float area;          // In units of a voxel's face; 0 where the triangle only touches the voxel.
    vec2 center;         // Barycentric coordinates of the centroid; without area, of a point close to the voxel.
    uint axis;           // Dominant axis of the triangle.
    uint subSamples;     // Sub-samples of the face across `axis`, without those that an alpha mask removes.
    vec2 texCoordWidth;  // log2 of a voxel's width in texture coordinates 0 and 1.
};

// The fragment callback, defined by the including shader.
void processFragment(TriangleFragment f);

// Area of the clipped triangle in voxel faces, and its centroid over x and y; each method defines it.
float measureFragment(GridTriangle t, ivec3 permutedVoxel, uint subSamples, out vec2 center);

TriangleFragment triangleFragment(GridTriangle t, ivec3 permutedVoxel) {
    return TriangleFragment(t.index, unpermuted(permutedVoxel, t.axis), t, permutedVoxel);
}

bool isAlphaMasked(TriangleFragment f) {
    return sceneMaterials.data[triangleMaterial(f.triangle)].alphaMode == ALPHA_MASK;
}

// The sub-samples that pass the alpha mask. A fragment without sub-samples is tested at the triangle's point nearest to
// the center of the column: the result is CENTER or 0.
uint opaqueSubSamples(TriangleFragment f, uint subSamples) {
    const GpuMaterial m = sceneMaterials.data[triangleMaterial(f.triangle)];
    return opaqueSubSamples(f.permutedTriangle, m, f.permutedVoxel, subSamples == 0u ? CENTER : subSamples);
}

// Whether any sub-sample passes the alpha mask.
bool passesAlphaMask(TriangleFragment f) {
    return !isAlphaMasked(f) || opaqueSubSamples(f, dominantAxisSubSamples(f.permutedTriangle, f.permutedVoxel)) != 0u;
}

// Measures the fragment; false where the alpha mask removes it. Otherwise the mask scales the area by the fraction of
// sub-samples that pass.
bool clipFragment(TriangleFragment f, out ClippedFragment c) {
    const GridTriangle t = f.permutedTriangle;
    const bool masked = isAlphaMasked(f);
    const uint covered = dominantAxisSubSamples(t, f.permutedVoxel);
    const uint opaque = masked ? opaqueSubSamples(f, covered) : covered;
    if (masked && opaque == 0u) return false;

    vec2 center;
    c.area = measureFragment(t, f.permutedVoxel, covered, center);
    if (masked && covered != 0u) c.area *= float(bitCount(opaque)) / float(bitCount(covered));
    c.center = barycentricsAt(t, center);
    c.axis = t.axis;
    c.subSamples = opaque & covered;
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
    if (!isAlphaMasked(f)) byAxis = otherAxesSubSamples(f.permutedTriangle, f.permutedVoxel);
    byAxis[c.axis] = c.subSamples;
    return byAxis;
}

#endif
