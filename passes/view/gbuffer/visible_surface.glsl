// A visible surface point as the G-buffer stores it, for rays and raster alike.
#include "passes/view/camera_view.glsl"
#include "shaders/scene/footprint.glsl"
#include "shaders/scene/specular.glsl"

struct VisibleSurface {
    vec3 normal;           // Shading normal, towards the camera.
    vec3 geometricNormal;  // Towards the camera.
    vec3 albedo;
    vec3 emission;
    Specular specular;
};

VisibleSurface visibleSurface(CameraView view, SurfacePoint s) {
    const GpuMaterial m = materialOfKinds(s.material);
    const vec3 toPoint = s.position - view.origin;
    const float distance_ = max(length(toPoint), 1e-20);
    const vec3 direction = toPoint / distance_;

    // Flip normals towards the camera by the geometric normal; slivers have none and face it exactly
    const float cosine = -dot(s.geometricNormal, direction);
    const bool front = cosine >= 0.0;
    VisibleSurface visible;
    visible.geometricNormal = front ? s.geometricNormal : -s.geometricNormal;
    if (dot(s.geometricNormal, s.geometricNormal) == 0.0) visible.geometricNormal = -direction;

    // Textures are filtered over the texel's footprint on the surface, by mip level; with SHARP_NORMALS normal maps are
    // not, with SHARP_COLORS all other textures are not
    const float area = texelSolidAngle(view, direction) * distance_ * distance_ / max(abs(cosine), 1e-4);
#ifdef SHARP_NORMALS
    visible.normal = shadingNormal(m, s, 0.0);
#else
    visible.normal = shadingNormal(m, s, footprintLevel(m.normalTexture, s, area));
#endif
    if (dot(visible.normal, visible.normal) == 0.0) visible.normal = visible.geometricNormal;
    if (dot(visible.normal, visible.geometricNormal) < 0.0) visible.normal = -visible.normal;
#ifdef SHARP_COLORS
    const float colorArea = 0.0;
#else
    const float colorArea = area;
#endif
    // Mip levels of cut-out textures would mix in colors of texels that are cut away
    const float colorLevel = m.alphaMode == ALPHA_MASK ? 0.0 : footprintLevel(m.baseColorTexture, s, colorArea);
    const vec3 base = baseColor(m, s, colorLevel).rgb;
    const float roughnessLevel = footprintLevel(m.metallicRoughnessTexture, s, colorArea);
    const vec2 roughnessMetallic = lookup(m.metallicRoughnessTexture, s.texCoords, roughnessLevel).gb;
    const float metallic = m.metallic * roughnessMetallic.y;
    visible.albedo = base * (1.0 - metallic);
    const float roughness = m.roughness * roughnessMetallic.x;
    visible.specular = makeSpecular(base, metallic, roughness, m.specular, m.specularColor, m.ior);
    visible.emission = front || m.doubleSided != 0u
                           ? emission(m, s, footprintLevel(m.emissiveTexture, s, colorArea))
                           : vec3(0.0);
    return visible;
}
