// The surface at a ray's hit, filtered to the ray's footprint.
#ifndef VOXRAY_HIT_SURFACE_GLSL
#define VOXRAY_HIT_SURFACE_GLSL

#include "shaders/scene/footprint.glsl"
#include "shaders/scene/inset_barycentrics.glsl"
#include "shaders/scene/specular.glsl"
#include "shaders/trace/ray_types.h"

struct HitSurface {
    vec3 position;
    vec3 faceNormal;  // Geometric, on the ray's side.
    vec3 normal;      // Shading normal, on the same side.
    vec3 albedo;
    vec3 emission;    // Towards the ray, W/(m² sr).
    Specular specular;
    float offset;     // Of ray origins along the face normal, m.
};

// `direction` has unit length; `area`: of the footprint across the ray, m². False for a triangle without area.
bool surfaceAtHit(Hit hit, vec3 direction, float area, out HitSurface surface) {
    const SurfacePoint s = surfacePoint(hit.triangle, insetBarycentrics(hit.triangle, vec2(hit.u, hit.v)));
    if (dot(s.geometricNormal, s.geometricNormal) == 0.0) return false;
    const GpuMaterial m = sceneMaterials.data[s.material];
    const float cosine = -dot(s.geometricNormal, direction);
    const bool isFront = cosine >= 0.0;
    surface.position = s.position;
    surface.offset = s.offset;
    surface.faceNormal = isFront ? s.geometricNormal : -s.geometricNormal;

    // Textures at the footprint's mip level; level 0 of alpha masks, whose coarser levels include the color of removed
    // texels
    const float surfaceArea = area / max(abs(cosine), 1e-4);
    surface.normal = shadingNormal(m, s, footprintLevel(m.normalTexture, s, surfaceArea));
    if (dot(surface.normal, surface.faceNormal) < 0.0) surface.normal = -surface.normal;
    const vec3 base =
        baseColor(m, s, m.alphaMode == ALPHA_MASK ? 0.0 : footprintLevel(m.baseColorTexture, s, surfaceArea)).rgb;
    const vec2 rough =
        lookup(m.metallicRoughnessTexture, s.texCoords, footprintLevel(m.metallicRoughnessTexture, s, surfaceArea)).gb;
    const float metallic = m.metallic * rough.y;
    surface.albedo = clamp(base * (1.0 - metallic), 0.0, 1.0);
    surface.specular = makeSpecular(base, metallic, m.roughness * rough.x, m.specular, m.specularColor, m.ior);
    const bool emits = isFront || m.doubleSided != 0u;
    surface.emission = emits ? emission(m, s, footprintLevel(m.emissiveTexture, s, surfaceArea)) : vec3(0.0);
    return true;
}

#ifdef HYBRID
#include "passes/hybrid_leaves/grid_cell.glsl"

bool isCell(Hit hit) { return (hit.triangle & HIT_IS_CELL) != 0u && hit.triangle != NO_HIT; }

// The surface of a grid cell. The fraction that its diffuse lobe loses is that of a dielectric layer; metals have no
// diffuse lobe.
void surfaceOfCell(Hit hit, Ray ray, out HitSurface surface) {
    const GridCell cell = gridCell(hit.triangle & ~HIT_IS_CELL);
    const bool isFront = dot(cell.normal, ray.direction) <= 0.0;
    surface.position = ray.origin + hit.t * ray.direction;
    surface.offset = pointOffset(surface.position);
    surface.normal = surface.faceNormal = isFront ? cell.normal : -cell.normal;
    surface.albedo = cell.albedo;
    const ExtendedCell extended = extendedCell(hit.triangle & ~HIT_IS_CELL);
    surface.emission = isFront || extended.emitsBothSides ? extended.emission : vec3(0.0);
    surface.specular = Specular(extended.f0, extended.f90, extended.roughness,
                                max(extended.f0.r, max(extended.f0.g, extended.f0.b)), extended.f90);
}
#endif

#endif
