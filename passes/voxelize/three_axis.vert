#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/scene.glsl"
#include "shaders/shared/voxel_types.h"

layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint axis;
    uint samples;
    float emissionScale;
} push;

layout(location = 0) out vec3 gridPosition;
layout(location = 1) out vec2 barycentrics;
layout(location = 2) flat out uint triangle;

void main() {
    const uint corner = uint(gl_VertexIndex) % 3u;
    triangle = uint(gl_VertexIndex) / 3u;
    barycentrics = vec2(corner == 1u ? 1.0 : 0.0, corner == 2u ? 1.0 : 0.0);
    gridPosition = (vertexPosition(triangleVertices(triangle)[corner]) - push.grid.origin) / push.grid.voxelSize;

    // Orthographic along the axis; the next two axes in cyclic order span the image.
    const uint a = push.axis, b = (a + 1u) % 3u, c = (a + 2u) % 3u;
    const vec2 plane = vec2(gridPosition[b] / float(push.grid.resolution[b]), gridPosition[c] / float(push.grid.resolution[c]));
    gl_Position = vec4(2.0 * plane - 1.0, 0.5, 1.0);
}
