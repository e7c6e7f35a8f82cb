// Looks at each triangle along the axis that it faces most and draws the box round it, grown by more than half a pixel: every
// pixel that the grown triangle touches has its center inside. The fragment shader drops the box's other pixels.
#include "passes/common/triangle_walk/grid_triangle.glsl"
#include "passes/common/triangle_walk/walk_push.glsl"
layout(triangles) in;
layout(triangle_strip, max_vertices = 4) out;

layout(location = 0) flat in uint triangles[];
layout(location = 0) flat out uint triangle;
layout(location = 1) flat out uint axis;

void main() {
    const uvec3 v = triangleVertices(triangles[0]);
    const vec3 p0 = gridVertex(walk.grid, v.x);
    const uint dominant = dominantAxis(cross(gridVertex(walk.grid, v.y) - p0, gridVertex(walk.grid, v.z) - p0));
    const GridTriangle t = gridTriangle(walk.grid, triangles[0], dominant);
    if (t.area == 0.0) return;
    // Half a pixel, and what the rasteriser's fixed point may take off it.
    const float grow = 0.5 + 1.0 / 64.0;
    const vec2 lower = 2.0 * (t.lower.xy - grow) / float(walk.imageSide) - 1.0;
    const vec2 upper = 2.0 * (t.upper.xy + grow) / float(walk.imageSide) - 1.0;
    for (int corner = 0; corner < 4; ++corner) {
        triangle = triangles[0];
        axis = dominant;
        gl_Position = vec4((corner & 1) == 0 ? lower.x : upper.x, (corner & 2) == 0 ? lower.y : upper.y, 0.5, 1.0);
        EmitVertex();
    }
    EndPrimitive();
}
