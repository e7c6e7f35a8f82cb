// Rays from light sources of every kind. Needs the bindings of shaders/scene/scene.glsl.
#ifndef VOXRAY_LIGHT_EMISSION_GLSL
#define VOXRAY_LIGHT_EMISSION_GLSL

#include "passes/inject/light_paths/light_path_types.h"
#include "shaders/lights/lights.glsl"
#include "shaders/scene/sampling.glsl"
#include "shaders/scene/scene.glsl"
#include "shaders/trace/ray_types.h"

// A point on a disc across `direction`, at EmittingSource::start before the center of the scene's region: on the disc
// that the region's sphere projects onto or, a quarter of the points, on the ring around it, from which surfaces around
// the region reflect light into it. There is no ring without such surfaces. `area`: m², one over the point's density.
vec3 discPoint(EmittingSource e, vec2 u, vec3 direction, out float area) {
    const float inner = e.sceneRadius * e.sceneRadius;
    const float ring = pow(min(RING_RADII * e.sceneRadius, e.reach), 2.0) - inner;
    const float ringProbability = ring > 0.0 ? 0.25 : 0.0;
    const bool isOnRing = u.x < ringProbability;
    const float v = isOnRing ? u.x / ringProbability : (u.x - ringProbability) / (1.0 - ringProbability);
    area = PI * (isOnRing ? ring / ringProbability : inner / (1.0 - ringProbability));

    vec3 t, b;
    frame(direction, t, b);
    const float r = sqrt(isOnRing ? inner + ring * v : inner * v), phi = 2.0 * PI * u.y;
    return e.sceneCenter - direction * e.start + t * (r * cos(phi)) + b * (r * sin(phi));
}

// Sets the ray's origin and direction, and the path's power and cross-section, as if this were the source's only ray.
void emitPunctual(EmittingSource e, vec2 u, inout Ray ray, inout LightPath path) {
    const GpuLight light = sceneLights.data[e.light];
    ray.origin = light.position;
    if (light.type == LIGHT_POINT) {
        // Uniform over the sphere: flux = I * 4 pi
        ray.direction = sphereDirection(u);
        path.solidAngle = 4.0 * PI;
        path.power = light.intensity * path.solidAngle;
    } else if (light.type == LIGHT_SPOT) {
        // Uniform over the outer cone: flux = I(angle) * the cone's solid angle
        ray.direction = coneDirection(u, light.direction, light.cosOuter);
        path.solidAngle = 2.0 * PI * (1.0 - light.cosOuter);
        path.power = light.intensity * spotFalloff(light, dot(ray.direction, light.direction)) * path.solidAngle;
    } else {
        // Flux = E * area
        ray.direction = light.direction;
        ray.origin = discPoint(e, u, light.direction, path.area);
        path.power = light.intensity * path.area;
    }
}

// A triangle by power, a uniform point on it, a cosine-distributed direction: flux = L * pi * area / probability.
void emitFromSurface(EmittingSource e, uint index, vec2 u, vec2 onTriangle, inout Ray ray, inout LightPath path) {
    const float pick = sobol2(index, hashCombine(e.seed, 2u)).x;
    const GpuEmitter emitter = sceneEmitters.data[pickEmitter(e.emitterCount, pick)];
    const SurfacePoint s = surfacePoint(emitter.triangle, trianglePoint(onTriangle));
    const GpuMaterial m = sceneMaterials.data[s.material];
    const float sides = m.doubleSided != 0u ? 2.0 : 1.0;
    const bool back = m.doubleSided != 0u && (hash(hashCombine(e.seed, index)) & 1u) != 0u;
    const vec3 n = back ? -s.geometricNormal : s.geometricNormal;
    ray.origin = s.position + n * s.offset;
    ray.direction = cosineDirection(u, n);
    path.power = emittedRadiance(m, s) * PI * emitter.area * sides / emitter.probability;
}

// Directions as the map's radiance, uniform without a map: flux = L * area / density.
void emitFromEnvironment(EmittingSource e, vec2 u, vec2 onDisc, inout Ray ray, inout LightPath path) {
    float density = 1.0 / (4.0 * PI), area;
    const vec3 direction = hasEnvironmentMap() ? sampleEnvironmentMap(u, density) : sphereDirection(u);
    ray.direction = -direction;
    ray.origin = discPoint(e, onDisc, ray.direction, area);
    path.power = environmentRadiance(direction) * area / density;
}

// Ray `index` of a source, with its fraction of the source's power; inactive without power. Rays of one seed are
// stratified: they take consecutive points of a Sobol sequence.
Ray emitLightRay(EmittingSource e, uint index, out LightPath path) {
    const vec2 u = sobol2(index, hashCombine(e.seed, 0u));
    const vec2 u2 = sobol2(index, hashCombine(e.seed, 1u));
    Ray ray = Ray(vec3(0.0), 0.0, vec3(0.0, 0.0, 1.0), 1.0e30);
    path = LightPath(vec3(0.0), 0.0, 0.0, 0.0);
    if (e.kind == SOURCE_PUNCTUAL) emitPunctual(e, u, ray, path);
    else if (e.kind == SOURCE_EMITTERS) emitFromSurface(e, index, u, u2, ray, path);
    else emitFromEnvironment(e, u, u2, ray, path);

    if (all(equal(path.power, vec3(0.0)))) ray.tMax = -1.0;
    path.power /= float(e.rays);
    path.solidAngle /= float(e.rays);
    path.area /= float(e.rays);
    return ray;
}

#endif
