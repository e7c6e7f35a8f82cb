#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/common/triangle_walk/grid_triangle.glsl"

layout(set = 0, binding = 17) readonly buffer DrawnTriangles { uint data[]; } drawnTriangles;
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint axis;
    uint samples;
    float emissionScale;
} push;

layout(location = 0) out vec3 gridPosition;
layout(location = 1) out vec2 barycentrics;
layout(location = 2) flat out uint triangle;
layout(location = 3) flat out vec2 depths;  // Of the triangle, along the axis: least and most.

void main() {
    const uint corner = uint(gl_VertexIndex) % 3u;
    triangle = drawnTriangles.data[gl_VertexIndex / 3];
    barycentrics = vec2(corner == 1u ? 1.0 : 0.0, corner == 2u ? 1.0 : 0.0);
    const uvec3 v = triangleVertices(triangle);
    gridPosition = gridVertex(push.grid, v[corner]);

    // Orthographic along the axis; the next two axes in cyclic order span the image.
    const uint a = push.axis, b = (a + 1u) % 3u, c = (a + 2u) % 3u;
    const vec3 depth = vec3(gridVertex(push.grid, v.x)[a], gridVertex(push.grid, v.y)[a], gridVertex(push.grid, v.z)[a]);
    depths = vec2(min(depth.x, min(depth.y, depth.z)), max(depth.x, max(depth.y, depth.z)));
    const vec2 plane = vec2(gridPosition[b] / float(push.grid.resolution[b]), gridPosition[c] / float(push.grid.resolution[c]));
    gl_Position = vec4(2.0 * plane - 1.0, 0.5, 1.0);
}
