// What a ray meets, as the camera would see it there.
#ifndef VOXRAY_MIRROR_SURFACE_GLSL
#define VOXRAY_MIRROR_SURFACE_GLSL

#include "shaders/scene/footprint.glsl"
#include "shaders/scene/off_edges.glsl"
#include "shaders/scene/specular.glsl"
#include "shaders/trace/ray_types.h"

struct MirrorSurface {
    vec3 position;
    vec3 faceNormal;  // Geometric, on the side that the ray came from.
    vec3 normal;      // Shading normal, likewise.
    vec3 albedo;
    vec3 emission;    // Towards the ray, W/(m² sr).
    Specular specular;
    float offset;     // m, along the face normal: there rays begin.
};

// At a hit of a ray along unit `direction`, whose footprint there is `area` m² across the ray. False for a triangle without area.
bool surfaceAtHit(Hit hit, vec3 direction, float area, out MirrorSurface at) {
    const SurfacePoint s = surfacePoint(hit.triangle, offEdges(hit.triangle, vec2(hit.u, hit.v)));
    if (dot(s.geometricNormal, s.geometricNormal) == 0.0) return false;
    const GpuMaterial m = sceneMaterials.data[s.material];
    const float cosine = -dot(s.geometricNormal, direction);
    const bool isFront = cosine >= 0.0;
    at.position = s.position;
    at.offset = s.offset;
    at.faceNormal = isFront ? s.geometricNormal : -s.geometricNormal;

    // Textures at the mip level of the footprint on the surface. Mip levels of a cut-out mix in the colour of what is cut away.
    const float onSurface = area / max(abs(cosine), 1e-4);
    at.normal = shadingNormal(m, s, footprintLevel(m.normalTexture, s, onSurface));
    if (dot(at.normal, at.faceNormal) < 0.0) at.normal = -at.normal;
    const vec3 base = baseColor(m, s, m.alphaMode == ALPHA_MASK ? 0.0 : footprintLevel(m.baseColorTexture, s, onSurface)).rgb;
    const vec2 rough =
        lookup(m.metallicRoughnessTexture, s.texCoords, footprintLevel(m.metallicRoughnessTexture, s, onSurface)).gb;
    const float metallic = m.metallic * rough.y;
    at.albedo = clamp(base * (1.0 - metallic), 0.0, 1.0);
    at.specular = makeSpecular(base, metallic, m.roughness * rough.x, m.specular, m.specularColor, m.ior);
    const bool emits = isFront || m.doubleSided != 0u;
    at.emission = emits ? emission(m, s, footprintLevel(m.emissiveTexture, s, onSurface)) : vec3(0.0);
    return true;
}

#ifdef HYBRID
#include "passes/hybrid_leaves/grid_cell.glsl"

bool isCell(Hit hit) { return (hit.triangle & HIT_IS_CELL) != 0u && hit.triangle != NO_HIT; }

// A cell of a grid. What its diffuse lobe loses to the specular one above it is that of a dielectric; metals have none.
void surfaceOfCell(Hit hit, Ray ray, out MirrorSurface at) {
    const GridCell cell = gridCell(hit.triangle & ~HIT_IS_CELL);
    const bool isFront = dot(cell.normal, ray.direction) <= 0.0;
    at.position = ray.origin + hit.t * ray.direction;
    at.offset = pointOffset(at.position);
    at.normal = at.faceNormal = isFront ? cell.normal : -cell.normal;
    at.albedo = cell.albedo;
    const BrightCell bright = brightCell(hit.triangle & ~HIT_IS_CELL);
    at.emission = isFront || bright.bothSides ? bright.emission : vec3(0.0);
    at.specular = Specular(bright.f0, bright.f90, bright.roughness, max(bright.f0.r, max(bright.f0.g, bright.f0.b)), bright.f90);
}
#endif

#endif
