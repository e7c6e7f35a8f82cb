// Projects the scene's triangles to a light's view.
#include "shaders/lights/light_view.glsl"
#include "shaders/scene/scene.glsl"

layout(location = 0) out vec2 barycentrics;
layout(location = 1) flat out uint triangle;
layout(location = 2) out float depth;  // Along the view's axis, over its farthest depth.
layout(push_constant, scalar) uniform Push { LightView view; } push;

void main() {
    const LightView view = push.view;
    triangle = uint(gl_VertexIndex) / 3u;
    const uint corner = uint(gl_VertexIndex) % 3u;
    barycentrics = vec2(corner == 1u ? 1.0 : 0.0, corner == 2u ? 1.0 : 0.0);
    const vec3 offset = vertexPosition(triangleVertices(triangle)[corner]) - view.origin;
    const float viewDepth = dot(offset, view.forward);
    const vec2 plane = vec2(dot(offset, view.right), dot(offset, view.up)) / view.halfExtent;
    const float z = (viewDepth - view.nearest) / (view.farthest - view.nearest);
    gl_Position = view.parallel != 0u ? vec4(plane, z, 1.0) : vec4(plane, z * view.farthest, viewDepth);
    depth = viewDepth / view.farthest;
}
