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
layout(location = 1) out vec4 texCoords;
layout(location = 2) out vec4 color;
layout(location = 3) flat out vec3 geometricNormal;
layout(location = 4) flat out uint material;

void main() {
    const uint triangle = uint(gl_VertexIndex) / 3u, corner = uint(gl_VertexIndex) % 3u;
    const vec2 barycentrics = vec2(corner == 1u ? 1.0 : 0.0, corner == 2u ? 1.0 : 0.0);
    const SurfacePoint s = surfacePoint(triangle, barycentrics);
    gridPosition = (s.position - push.grid.origin) / push.grid.voxelSize;
    texCoords = s.texCoords;
    color = s.color;
    geometricNormal = s.geometricNormal;
    material = s.material;

    // Orthographic along the axis; the next two axes in cyclic order span the image.
    const uint a = push.axis, b = (a + 1u) % 3u, c = (a + 2u) % 3u;
    const vec2 plane = vec2(gridPosition[b] / float(push.grid.resolution[b]), gridPosition[c] / float(push.grid.resolution[c]));
    gl_Position = vec4(2.0 * plane - 1.0, 0.5, 1.0);
}
