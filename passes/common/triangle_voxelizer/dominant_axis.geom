// Projects each triangle along its dominant axis and draws its bounding box, grown by more than half a pixel: all
// pixels that the triangle touches have their centers inside. The fragment shader discards the box's other pixels.
// Where the device finds the pixels (DRAWN_BY_DEVICE) the triangle itself is drawn. The image begins at the voxel
// grid.first.
#include "passes/common/triangle_voxelizer/grid_triangle.glsl"
#include "passes/common/triangle_voxelizer/voxelizer_push.glsl"
layout(triangles) in;
layout(triangle_strip, max_vertices = 4) out;

layout(location = 0) flat in uint triangles[];
layout(location = 0) flat out uint triangle;
layout(location = 1) flat out uint axis;

void main() {
    const uvec3 v = triangleVertices(triangles[0]);
    const vec3 p0 = gridVertex(voxelizer.grid, v.x);
    const uint dominant =
        dominantAxis(cross(gridVertex(voxelizer.grid, v.y) - p0, gridVertex(voxelizer.grid, v.z) - p0));
    const GridTriangle t = gridTriangle(voxelizer.grid, triangles[0], dominant);
    if (t.area == 0.0) return;
    const vec2 first = vec2(permutedVoxels(uvec3(voxelizer.grid.first), dominant).xy);
#ifdef DRAWN_BY_DEVICE
    for (int corner = 0; corner < 3; ++corner) {
        triangle = triangles[0];
        axis = dominant;
        const vec2 p = (corner == 0 ? t.p0 : corner == 1 ? t.p1 : t.p2).xy;
        gl_Position = vec4(2.0 * (p - first) / float(voxelizer.imageSide) - 1.0, 0.5, 1.0);
        EmitVertex();
    }
#else
    // Half a pixel and the error of the rasterizer's fixed-point coordinates.
    const float grow = 0.5 + 1.0 / 64.0;
    const vec2 lower = 2.0 * (t.lower.xy - grow - first) / float(voxelizer.imageSide) - 1.0;
    const vec2 upper = 2.0 * (t.upper.xy + grow - first) / float(voxelizer.imageSide) - 1.0;
    for (int corner = 0; corner < 4; ++corner) {
        triangle = triangles[0];
        axis = dominant;
        gl_Position = vec4((corner & 1) == 0 ? lower.x : upper.x, (corner & 2) == 0 ? lower.y : upper.y, 0.5, 1.0);
        EmitVertex();
    }
#endif
    EndPrimitive();
}
