#include "passes/view/gbuffer/visible_surface.glsl"

layout(push_constant, scalar) uniform Push {
    mat4 viewProjection;
    CameraView view;
} push;

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tangent;
layout(location = 3) in vec4 texCoords;
layout(location = 4) in vec4 color;
layout(location = 5) flat in vec3 geometricNormal;
layout(location = 6) flat in uint material;
layout(location = 7) flat in vec2 uvDensity;
layout(location = 8) flat in float planeOffset_;
#ifdef MOTION
layout(location = 9) in vec3 previous;
layout(location = 10) flat in float instance;
#endif

layout(location = 0) out vec4 outPosition;
layout(location = 1) out vec4 outNormal;
layout(location = 2) out vec4 outGeometricNormal;
layout(location = 3) out vec4 outAlbedo;
layout(location = 4) out vec4 outEmission;
layout(location = 5) out vec4 outSpecular;
layout(location = 6) out vec4 outFresnel;
#ifdef MOTION
layout(location = 7) out vec4 outPrevious;
#endif

void main() {
    SurfacePoint s;
    s.position = position;
    s.geometricNormal = geometricNormal;
    s.normal = dot(normal, normal) > 0.0 ? normalize(normal) : geometricNormal;
    s.tangent = tangent;
    s.texCoords = texCoords;
    s.color = color;
    s.uvDensity = uvDensity;
    s.material = material;
    s.offset = max(planeOffset_, pointOffset(position));
    if (alphaCut(sceneMaterials.data[material], s)) discard;

    const VisibleSurface visible = visibleSurface(push.view, s);
    outPosition = vec4(position, s.offset);
    outNormal = vec4(visible.normal, 0.0);
    outGeometricNormal = vec4(visible.geometricNormal, 0.0);
    outAlbedo = vec4(visible.albedo, 1.0);
    outEmission = vec4(visible.emission, 0.0);
    outSpecular = specularTexel(visible.specular);
    outFresnel = fresnelTexel(visible.specular);
#ifdef MOTION
    outPrevious = vec4(previous, instance);
#endif
}
