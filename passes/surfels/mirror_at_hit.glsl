// Perfect mirrors where rays of a gather hit: they hold no diffuse light, and the path goes on in one direction. Needs
// the bindings of shaders/scene/scene.glsl.
#ifndef VOXRAY_MIRROR_AT_HIT_GLSL
#define VOXRAY_MIRROR_AT_HIT_GLSL

#include "passes/surfels/surfel_at_hit.glsl"
#include "shaders/scene/specular.glsl"

// Turns the surfel at the hit of a ray from `origin` into a mirror's vertex, whose normal is the direction of the path's
// next ray and whose reflectance is the mirror's. False where the surface has a diffuse lobe or is no perfect mirror.
bool reflectAtMirror(Hit hit, vec3 origin, vec3 faceNormal, inout Surfel s) {
    if (any(greaterThan(s.reflectance, vec3(0.0)))) return false;
    const SurfacePoint p = surfacePoint(hit.triangle, vec2(hit.u, hit.v));
    const GpuMaterial m = sceneMaterials.data[p.material];
    const vec2 texel = lookup(m.metallicRoughnessTexture, p.texCoords, 0.0).gb;
    const Specular lobe = makeSpecular(baseColor(m, p, 0.0).rgb, m.metallic * texel.y, m.roughness * texel.x,
                                       m.specular, m.specularColor, m.ior);
    if (!hasSpecular(lobe) || !isMirror(lobe)) return false;
    const vec3 back = normalize(origin - p.position), normal = specularNormal(s.normal, back);
    s.normal = reflect(-back, normal);
    const bool isAbove = dot(s.normal, faceNormal) > 0.0;
    s.reflectance = isAbove ? specularFresnel(lobe, schlickWeight(min(dot(normal, back), 1.0))) : vec3(0.0);
    s.voxel = VOXRAY_MIRROR_VERTEX;
    return true;
}

// What the surface at a hit emits against the ray, W/(m² sr).
vec3 emittedTowards(Hit hit, Ray ray) {
    const SurfacePoint p = surfacePoint(hit.triangle, vec2(hit.u, hit.v));
    const GpuMaterial m = sceneMaterials.data[p.material];
    const bool isLit = m.doubleSided != 0u || dot(p.geometricNormal, ray.direction) < 0.0;
    return isLit ? emission(m, p, 0.0) : vec3(0.0);
}

// What the ray of a mirror's vertex finds of lamps and environment, W/(m² sr): no shadow ray to them has begun there.
vec3 emittedTowardsMirror(Hit hit, Ray ray) {
    return hit.triangle == NO_HIT ? environmentRadiance(ray.direction) : emittedTowards(hit, ray);
}

#endif
