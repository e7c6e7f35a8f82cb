// Projects triangles along one axis; the next two axes in cyclic order span the image.
#include "passes/common/triangle_voxelizer/grid_triangle.glsl"
#include "passes/common/triangle_voxelizer/voxelizer_push.glsl"

readonly buffer DrawnTriangles { uint data[]; } drawnTriangles;

layout(location = 0) out vec3 gridPosition;
layout(location = 1) out vec2 barycentrics;
layout(location = 2) flat out uint triangle;
layout(location = 3) flat out vec2 depths;  // Of the triangle, along the axis: min and max.

void main() {
    const uint corner = uint(gl_VertexIndex) % 3u;
    triangle = drawnTriangles.data[gl_VertexIndex / 3];
    barycentrics = vec2(corner == 1u ? 1.0 : 0.0, corner == 2u ? 1.0 : 0.0);
    const uvec3 v = triangleVertices(triangle);
    gridPosition = gridVertex(voxelizer.grid, v[corner]);

    const uint a = voxelizer.axis, b = (a + 1u) % 3u, c = (a + 2u) % 3u;
    const vec3 depth = vec3(gridVertex(voxelizer.grid, v.x)[a], gridVertex(voxelizer.grid, v.y)[a],
                            gridVertex(voxelizer.grid, v.z)[a]);
    depths = vec2(min(depth.x, min(depth.y, depth.z)), max(depth.x, max(depth.y, depth.z)));
    const vec2 plane = vec2(gridPosition[b] / float(voxelizer.grid.resolution[b]),
                            gridPosition[c] / float(voxelizer.grid.resolution[c]));
    gl_Position = vec4(2.0 * plane - 1.0, 0.5, 1.0);
}
