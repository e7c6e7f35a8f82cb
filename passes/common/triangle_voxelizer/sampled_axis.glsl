// A pixel is a column of voxels along the triangle's dominant axis (Arnebäck 2017, section 3.2.1). A pixel with a
// sample point in the triangle yields one voxel: that in which the line through the pixel's center intersects the
// triangle's plane. Entry point of fragment shaders that define processFragment().
#include "passes/common/triangle_voxelizer/sub_samples.glsl"
#include "passes/common/triangle_voxelizer/voxelizer_push.glsl"

layout(location = 0) flat in uint triangle;
layout(location = 1) flat in uint axis;
#ifdef LEVELS
layout(location = 2) flat in uint level;
#else
const uint level = 0u;
#endif

struct TriangleFragment {
    uint triangle;
    ivec3 voxel;  // In grid coordinates.
    uint level;   // Of LEVELS grids; 0 where there is one.
    vec2 barycentrics;
};

// The fragment callback, defined by the including shader.
void processFragment(TriangleFragment f);

bool passesAlphaMask(TriangleFragment f) {
    const SurfacePoint s = surfacePoint(f.triangle, f.barycentrics);
    return !alphaCut(sceneMaterials.data[s.material], s);
}

// Eight samples of a pixel, the standard pattern, in sixteenths of its width from its center.
const ivec2 kEightSamples[8] = ivec2[8](ivec2(1, -3), ivec2(-1, 3), ivec2(5, 1), ivec2(-3, -5), ivec2(-5, 5),
                                        ivec2(-7, -1), ivec2(3, 7), ivec2(7, -7));

bool isCovered(GridTriangle t, vec2 center) {
    for (uint i = 0u; i < voxelizer.samples; ++i) {
        const vec2 point = voxelizer.samples == 1u ? center : center + vec2(kEightSamples[i]) / 16.0;
        if (isInsideEdge(t.p0.xy, t.p1.xy, t.winding.z, point) && isInsideEdge(t.p1.xy, t.p2.xy, t.winding.z, point) &&
            isInsideEdge(t.p2.xy, t.p0.xy, t.winding.z, point))
            return true;
    }
    return false;
}

void main() {
    const VoxelGrid grid = DRAWN_GRID(level);
    const GridTriangle t = gridTriangle(grid, triangle, axis);
    const ivec3 first = ivec3(permutedVoxels(uvec3(grid.first), axis));
    const ivec3 end = ivec3(permutedVoxels(grid.resolution, axis));
    const ivec2 column = first.xy + ivec2(gl_FragCoord.xy);
    const vec2 center = vec2(column) + 0.5;
    if (any(greaterThanEqual(column, end.xy)) || t.winding.z == 0.0 || !isCovered(t, center)) return;
    const int depth = int(floor(depthAt(t, center)));
    if (depth < first.z || depth >= end.z) return;
    const ivec3 voxel = unpermuted(ivec3(column, depth), axis);
    processFragment(TriangleFragment(triangle, voxel, level, barycentricsAt(t, center)));
}
