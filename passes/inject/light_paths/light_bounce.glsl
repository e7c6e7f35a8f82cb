// Vertices of light paths and how they scatter. Needs the bindings of shaders/scene/scene.glsl.
#ifndef VOXRAY_LIGHT_BOUNCE_GLSL
#define VOXRAY_LIGHT_BOUNCE_GLSL

#include "passes/inject/light_paths/light_path_types.h"
#include "shaders/scene/sampling.glsl"
#include "shaders/scene/scene.glsl"
#include "shaders/trace/ray_types.h"

vec3 diffuseReflectance(GpuMaterial m, SurfacePoint s) { return clamp(diffuseAlbedo(m, s, 0.0), 0.0, 1.0); }

// Where a light ray hit a surface, on the side that it came from.
struct LightVertex {
    vec3 position;    // m
    vec3 normal;      // Unit shading normal.
    vec3 faceNormal;  // Unit normal of the triangle, on the same side.
    vec3 albedo;
    float offset;     // m; rays may begin that far along the face normal.
};

// `direction`: of the ray that hit `s`, a point of a triangle with area.
LightVertex lightVertex(SurfacePoint s, vec3 direction) {
    const GpuMaterial m = sceneMaterials.data[s.material];
    const vec3 faceNormal = dot(s.geometricNormal, direction) <= 0.0 ? s.geometricNormal : -s.geometricNormal;
    const vec3 normal = shadingNormal(m, s, 0.0);
    return LightVertex(s.position, dot(normal, faceNormal) < 0.0 ? -normal : normal, faceNormal,
                       diffuseReflectance(m, s), s.offset);
}

// Whether a ray comes from a punctual light, so that its cross-section is known (LightPath).
bool isBeam(LightPath path) { return path.solidAngle > 0.0 || path.area > 0.0; }

// Factor of the power of a light path that arrives at a vertex along `direction`, where a BSDF reflects it: power arrives
// by the geometric cosine, the BSDF reflects by the shading cosine, and what is reflected leaves by the geometric cosine
// of its direction (the adjoint BSDF, Veach 1997, section 5.3). 0 where the light comes from behind the shading normal.
float adjointFactor(LightVertex v, vec3 direction) {
    const float cosShading = -dot(v.normal, direction), cosGeometric = -dot(v.faceNormal, direction);
    return cosShading > 0.0 && cosGeometric > 0.0 ? cosShading / cosGeometric : 0.0;
}

// Scatters a ray at its vertex: as a mirror of that albedo about the shading normal (the choice of Magalhães 2020), or
// diffusely, by the cosine to the face normal, with Russian roulette by albedo. False where the path ends, by roulette or
// since no light goes on. `index`: of the ray among those of one seed. `seed`: a different one for each bounce.
bool bounceLightRay(LightVertex v, bool mirror, uint index, uint seed, inout Ray ray, inout LightPath path) {
    vec3 direction;
    if (mirror) {
        direction = reflect(ray.direction, v.normal);
        path.power *= v.albedo;
    } else {
        const float survival = survivalProbability(v.albedo);
        if (sobol2(index, hashCombine(seed, 1u)).x >= survival) return false;
        const float factor = adjointFactor(v, ray.direction);
        if (factor == 0.0) return false;
        direction = cosineDirection(sobol2(index, seed), v.faceNormal);
        path.power *= v.albedo * (factor / survival);
    }
    if (dot(direction, v.faceNormal) <= 0.0) return false;
    ray = Ray(v.position + v.faceNormal * v.offset, 0.0, direction, 1.0e30);
    return true;
}

#endif
