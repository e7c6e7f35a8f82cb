// Projects each triangle along its dominant axis and draws its bounding box, grown by more than half a pixel: all
// pixels that the triangle touches have their centers inside. The fragment shader discards the box's other pixels.
// Where the device finds the pixels (DRAWN_BY_DEVICE) the triangle itself is drawn. The image begins at the voxel
// grid.first. With LEVELS, an instance and a viewport for each grid.
#include "passes/common/triangle_voxelizer/grid_triangle.glsl"
#include "passes/common/triangle_voxelizer/voxelizer_push.glsl"
#ifdef LEVELS
layout(triangles, invocations = LEVELS) in;
#else
layout(triangles) in;
#endif
layout(triangle_strip, max_vertices = 4) out;

layout(location = 0) flat in uint triangles[];
layout(location = 0) flat out uint triangle;
layout(location = 1) flat out uint axis;
#ifdef LEVELS
layout(location = 2) flat out uint level;
#endif

void main() {
    const VoxelGrid grid = DRAWN_GRID(gl_InvocationID);
    if (any(greaterThanEqual(grid.first, ivec3(grid.resolution)))) return;
    const uvec3 v = triangleVertices(triangles[0]);
    const vec3 p0 = gridVertex(grid, v.x);
    const uint dominant =
        dominantAxis(cross(gridVertex(grid, v.y) - p0, gridVertex(grid, v.z) - p0));
    const GridTriangle t = gridTriangle(grid, triangles[0], dominant);
    if (t.area == 0.0) return;
    // One square image holds the columns along any axis.
    const ivec3 size = ivec3(grid.resolution) - grid.first;
    const float side = float(max(size.x, max(size.y, size.z)));
    const vec2 first = vec2(permutedVoxels(uvec3(grid.first), dominant).xy);
#ifdef DRAWN_BY_DEVICE
    for (int corner = 0; corner < 3; ++corner) {
        triangle = triangles[0];
        axis = dominant;
        const vec2 p = (corner == 0 ? t.p0 : corner == 1 ? t.p1 : t.p2).xy;
        gl_Position = vec4(2.0 * (p - first) / side - 1.0, 0.5, 1.0);
        EmitVertex();
    }
#else
    // Half a pixel and the error of the rasterizer's fixed-point coordinates.
    const float grow = 0.5 + 1.0 / 64.0;
    const vec2 lower = 2.0 * (t.lower.xy - grow - first) / side - 1.0;
    const vec2 upper = 2.0 * (t.upper.xy + grow - first) / side - 1.0;
    for (int corner = 0; corner < 4; ++corner) {
        triangle = triangles[0];
        axis = dominant;
#ifdef LEVELS
        level = gl_InvocationID;
        gl_ViewportIndex = gl_InvocationID;
#endif
        gl_Position = vec4((corner & 1) == 0 ? lower.x : upper.x, (corner & 2) == 0 ? lower.y : upper.y, 0.5, 1.0);
        EmitVertex();
    }
#endif
    EndPrimitive();
}
