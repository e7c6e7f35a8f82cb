#version 460
#extension GL_GOOGLE_include_directive : require
// One fragment: a surface sample in a voxel.
#include "passes/common/triangle_walk/grid_triangle.glsl"
#include "passes/common/voxel_builder/voxel_sums.glsl"

layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint axis;
    uint samples;
    float emissionScale;
} push;

layout(location = 0) in vec3 gridPosition;
layout(location = 1) in vec2 barycentrics;
layout(location = 2) flat in uint triangle;
layout(location = 3) flat in vec2 depths;

// The 4x4 sub-samples of the voxel's face that this sample stands for: those nearest to it.
uint subSamples() {
    const uvec2 sample_ = uvec2(gl_FragCoord.xy) % push.samples;
    uint mask = 0u;
    for (uint bit = 0u; bit < 16u; ++bit) {
        const uvec2 nearest = (2u * uvec2(bit % 4u, bit / 4u) + 1u) * push.samples / 8u;
        if (nearest == sample_) mask |= 1u << bit;
    }
    return mask;
}

void main() {
    const SurfacePoint s = surfacePoint(triangle, barycentrics);
    if (alphaCut(sceneMaterials.data[s.material], s)) discard;

    // The voxel: two coordinates from the sample point, so that rounding can't move it, the third from depth, which
    // interpolation may carry far beyond a triangle that is nearly edge-on.
    const uint a = push.axis, b = (a + 1u) % 3u, c = (a + 2u) % 3u;
    ivec3 voxel;
    voxel[a] = int(floor(clamp(gridPosition[a], depths.x, depths.y)));
    voxel[b] = int(gl_FragCoord.x) / int(push.samples);
    voxel[c] = int(gl_FragCoord.y) / int(push.samples);
    voxel = clamp(voxel, ivec3(0), ivec3(push.grid.resolution) - 1);

#ifdef MARK
    markVoxel(push.grid, voxel);
#else
    const uint number = voxelNumber(push.grid, voxel);
    if (number == NO_VOXEL) return;
    const float area = abs(s.geometricNormal[a]) / float(push.samples * push.samples);
    uvec3 covered = uvec3(0u);
    covered[a] = subSamples();
    const uvec3 v = triangleVertices(triangle);
    const vec3 p0 = gridVertex(push.grid, v.x);
    const vec3 cross_ = cross(gridVertex(push.grid, v.y) - p0, gridVertex(push.grid, v.z) - p0);
    addSurface(number, area, s, texCoordWidth(v, 0.5 * length(cross_)), covered, push.emissionScale);
#endif
}
