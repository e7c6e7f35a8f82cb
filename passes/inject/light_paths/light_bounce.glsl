// How a ray of light goes on from a surface. Needs the bindings of shaders/scene/scene.glsl.
#ifndef VOXRAY_LIGHT_BOUNCE_GLSL
#define VOXRAY_LIGHT_BOUNCE_GLSL

#include "passes/inject/light_paths/light_path_types.h"
#include "shaders/scene/sampling.glsl"
#include "shaders/scene/scene.glsl"
#include "shaders/trace/ray_types.h"

// The triangle's unit normal on the side that a ray along `direction` comes from; 0 for a triangle without area.
vec3 facingNormal(SurfacePoint s, vec3 direction) {
    return dot(s.geometricNormal, direction) <= 0.0 ? s.geometricNormal : -s.geometricNormal;
}

// The shading normal on the side of `faceNormal`.
vec3 facingShadingNormal(GpuMaterial m, SurfacePoint s, vec3 faceNormal) {
    const vec3 normal = shadingNormal(m, s, 0.0);
    return dot(normal, faceNormal) < 0.0 ? -normal : normal;
}

vec3 diffuseReflectance(GpuMaterial m, SurfacePoint s) { return clamp(diffuseAlbedo(m, s, 0.0), 0.0, 1.0); }

// A point that a ray of light hit, on the side that it came from.
struct LightVertex {
    vec3 position;    // m
    vec3 normal;      // Unit length: the shading normal, which light is reflected about.
    vec3 faceNormal;  // Unit length: the triangle's, on the same side.
    vec3 albedo;
    float offset;     // m, along the face normal: there rays begin.
};

// The point of a triangle with area, as the ray sees it.
LightVertex lightVertex(SurfacePoint s, vec3 direction) {
    const GpuMaterial m = sceneMaterials.data[s.material];
    const vec3 faceNormal = facingNormal(s, direction);
    return LightVertex(s.position, facingShadingNormal(m, s, faceNormal), faceNormal, diffuseReflectance(m, s), s.offset);
}

// Whether a ray is one of a punctual light, whose cross-section is known (LightPath).
bool isBeam(LightPath path) { return path.solidAngle > 0.0 || path.area > 0.0; }

// Takes a ray on from where it hit, as a mirror that takes its albedo off would, or distributed by cosine. False where it ends there:
// by Russian roulette by albedo, which keeps the power of surviving rays level, or below the surface. `index`: the ray's number among
// those of one seed. `seed`: another one for each bounce.
bool bounceLightRay(LightVertex p, bool mirror, uint index, uint seed, inout Ray ray, inout LightPath path) {
    vec3 direction;
    if (mirror) {
        direction = reflect(ray.direction, p.normal);
        path.power *= p.albedo;
    } else {
        const float chance = survivalProbability(p.albedo);
        if (sobol2(index, hashCombine(seed, 1u)).x >= chance) return false;
        direction = cosineDirection(sobol2(index, seed), p.normal);
        path.power *= p.albedo / chance;
    }
    if (dot(direction, p.faceNormal) <= 0.0) return false;
    ray = Ray(p.position + p.faceNormal * p.offset, 0.0, direction, 1.0e30);
    return true;
}

#endif
