#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/scene.glsl"

layout(push_constant, scalar) uniform Push {
    mat4 viewProjection;
    vec3 cameraPosition;
    float padding;
} push;

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tangent;
layout(location = 3) in vec4 texCoords;
layout(location = 4) in vec4 color;
layout(location = 5) flat in vec3 geometricNormal;
layout(location = 6) flat in uint material;

layout(location = 0) out vec4 outPosition;
layout(location = 1) out vec4 outNormal;
layout(location = 2) out vec4 outGeometricNormal;
layout(location = 3) out vec4 outAlbedo;
layout(location = 4) out vec4 outEmission;

void main() {
    SurfacePoint s;
    s.position = position;
    s.geometricNormal = geometricNormal;
    s.normal = dot(normal, normal) > 0.0 ? normalize(normal) : geometricNormal;
    s.tangent = tangent;
    s.texCoords = texCoords;
    s.color = color;
    s.material = material;
    const GpuMaterial m = sceneMaterials.data[material];
    if (alphaCut(m, s)) discard;

    // Normals face the camera; the geometric normal decides which side it sees.
    const vec3 toCamera = push.cameraPosition - position;
    const bool front = dot(geometricNormal, toCamera) >= 0.0;
    const vec3 facing = front ? geometricNormal : -geometricNormal;
    vec3 n = shadingNormal(m, s, 0.0);
    if (dot(n, facing) < 0.0) n = -n;

    outPosition = vec4(position, 1.0);
    outNormal = vec4(n, 0.0);
    outGeometricNormal = vec4(facing, 0.0);
    outAlbedo = vec4(diffuseAlbedo(m, s, 0.0), 1.0);
    outEmission = vec4(front || m.doubleSided != 0u ? emission(m, s, 0.0) : vec3(0.0), 0.0);
}
