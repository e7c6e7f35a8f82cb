#version 460
#extension GL_GOOGLE_include_directive : require
// Looks at each triangle along the axis that it faces most and draws the box round it, grown by more than half a pixel: every
// pixel that the grown triangle touches has its center inside. The fragment shader drops the box's other pixels.
#include "passes/common/triangle_walk/grid_triangle.glsl"
layout(triangles) in;
layout(triangle_strip, max_vertices = 4) out;

layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint imageSide;
    float emissionScale;
} push;

layout(location = 0) flat in uint triangles[];
layout(location = 0) flat out uint triangle;
layout(location = 1) flat out uint axis;

void main() {
    const uvec3 v = triangleVertices(triangles[0]);
    const vec3 p0 = gridVertex(push.grid, v.x);
    const uint facing = dominantAxis(cross(gridVertex(push.grid, v.y) - p0, gridVertex(push.grid, v.z) - p0));
    const GridTriangle t = gridTriangle(push.grid, triangles[0], facing);
    if (t.area == 0.0) return;
    // Half a pixel, and what the rasteriser's fixed point may take off it.
    const float grow = 0.5 + 1.0 / 64.0;
    const vec2 lower = 2.0 * (t.lower.xy - grow) / float(push.imageSide) - 1.0;
    const vec2 upper = 2.0 * (t.upper.xy + grow) / float(push.imageSide) - 1.0;
    for (int corner = 0; corner < 4; ++corner) {
        triangle = triangles[0];
        axis = facing;
        gl_Position = vec4((corner & 1) == 0 ? lower.x : upper.x, (corner & 2) == 0 ? lower.y : upper.y, 0.5, 1.0);
        EmitVertex();
    }
    EndPrimitive();
}
