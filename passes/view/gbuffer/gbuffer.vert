#include "passes/view/camera_view.glsl"
#include "shaders/scene/scene.glsl"
#ifdef MOTION
#include "passes/view/gbuffer/previous.glsl"
#endif

layout(push_constant, scalar) uniform Push {
    mat4 viewProjection;
    CameraView view;
} push;

layout(location = 0) out vec3 position;
layout(location = 1) out vec3 normal;
layout(location = 2) out vec4 tangent;
layout(location = 3) out vec4 texCoords;
layout(location = 4) out vec4 color;
layout(location = 5) flat out vec3 geometricNormal;
layout(location = 6) flat out uint material;
layout(location = 7) flat out vec2 uvDensity;
layout(location = 8) flat out float planeOffset_;
#ifdef MOTION
layout(location = 9) out vec3 previous;
layout(location = 10) flat out float instance;
#endif

void main() {
    const uint corner = uint(gl_VertexIndex) % 3u;
    const vec2 barycentrics = vec2(corner == 1u ? 1.0 : 0.0, corner == 2u ? 1.0 : 0.0);
    const SurfacePoint s = surfacePoint(uint(gl_VertexIndex) / 3u, barycentrics);
    position = s.position;
    normal = s.normal;
    tangent = s.tangent;
    texCoords = s.texCoords;
    color = s.color;
    uvDensity = s.uvDensity;
    const uvec3 v = triangleVertices(uint(gl_VertexIndex) / 3u);
    planeOffset_ = planeOffset(vertexPosition(v.x), vertexPosition(v.y), vertexPosition(v.z), s.geometricNormal);
#ifdef MOTION
    previous = previousPosition(uint(gl_VertexIndex) / 3u, barycentrics);
    instance = instanceOf(uint(gl_VertexIndex) / 3u);
#endif
    geometricNormal = s.geometricNormal;
    material = s.material;
    gl_Position = push.viewProjection * vec4(s.position, 1.0);

    // Back faces recede by 1e-4 of their distance (depth is reversed): at the silhouette they have the same depth as
    // the front faces, but for rounding, and must not win there
    if (dot(s.geometricNormal, push.view.origin - s.position) < 0.0) gl_Position.z *= 1.0 - 1e-4;
}
