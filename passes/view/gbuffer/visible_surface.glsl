// What a g-buffer keeps of a point that the camera sees, however the point was found.
#include "passes/view/gbuffer/view.glsl"
#include "shaders/scene/footprint.glsl"
#include "shaders/scene/specular.glsl"

struct VisibleSurface {
    vec3 normal;           // Shading normal, on the camera's side.
    vec3 geometricNormal;  // Likewise.
    vec3 albedo;
    vec3 emission;
    Specular specular;
};

VisibleSurface visibleSurface(View view, SurfacePoint s) {
    const GpuMaterial m = sceneMaterials.data[s.material];
    const vec3 away = s.position - view.origin;
    const float distance_ = max(length(away), 1e-20);
    const vec3 direction = away / distance_;

    // Normals face the camera; the geometric normal decides which side it sees. A sliver without one faces it squarely.
    const float cosine = -dot(s.geometricNormal, direction);
    const bool front = cosine >= 0.0;
    VisibleSurface visible;
    visible.geometricNormal = front ? s.geometricNormal : -s.geometricNormal;
    if (dot(s.geometricNormal, s.geometricNormal) == 0.0) visible.geometricNormal = -direction;

    // Textures at the mip level of the texel's footprint on the surface; with SHARP_NORMALS, normal maps at the very point, with
    // SHARP_COLORS all others.
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
    // Mip levels of a cut-out mix in the colour of what is cut away.
    const float colorLevel = m.alphaMode == ALPHA_MASK ? 0.0 : footprintLevel(m.baseColorTexture, s, colorArea);
    const vec3 base = baseColor(m, s, colorLevel).rgb;
    const vec2 rough = lookup(m.metallicRoughnessTexture, s.texCoords, footprintLevel(m.metallicRoughnessTexture, s, colorArea)).gb;
    const float metallic = m.metallic * rough.y;
    visible.albedo = base * (1.0 - metallic);
    visible.specular = makeSpecular(base, metallic, m.roughness * rough.x, m.specular, m.specularColor, m.ior);
    visible.emission = front || m.doubleSided != 0u
                           ? emission(m, s, footprintLevel(m.emissiveTexture, s, colorArea))
                           : vec3(0.0);
    return visible;
}
