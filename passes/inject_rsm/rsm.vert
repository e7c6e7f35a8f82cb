#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/scene.glsl"
#include "passes/inject_rsm/rsm_view.glsl"

layout(location = 0) out vec2 barycentrics;
layout(location = 1) flat out uint triangle;

void main() {
    triangle = uint(gl_VertexIndex) / 3u;
    const uint corner = uint(gl_VertexIndex) % 3u;
    barycentrics = vec2(corner == 1u ? 1.0 : 0.0, corner == 2u ? 1.0 : 0.0);
    const vec3 away = vertexPosition(triangleVertices(triangle)[corner]) - push.origin;
    const float depth = dot(away, push.forward);
    const vec2 plane = vec2(dot(away, push.right), dot(away, push.up)) / push.halfExtent;
    const float z = (depth - push.near) / (push.far - push.near);
    gl_Position = push.parallel != 0u ? vec4(plane, z, 1.0) : vec4(plane, z * push.far, depth);
}
