// Light samples as seen from a point.
#ifndef VOXRAY_LIGHTS_GLSL
#define VOXRAY_LIGHTS_GLSL

#include "shaders/scene/sampling.glsl"
#include "shaders/lights/spherical_triangle.glsl"
#include "shaders/scene/scene.glsl"

// Kinds of sources, as LightSource::Kind in passes/common/lights/light_sources.h has them.
#define SOURCE_PUNCTUAL 0u
#define SOURCE_EMITTERS 1u
#define SOURCE_ENVIRONMENT 2u

struct LightSample {
    vec3 direction;   // Towards the light, unit length.
    float distance_;  // m
    float reach;      // m: of a shadow ray, which ends short of the surface that the light lies on.
    vec3 irradiance;  // W/m² on a surface that faces the sample, divided by the density of picking it.
};

// Point: I / d²; spot: that times its falloff; directional: E.
LightSample samplePunctual(GpuLight light, vec3 position) {
    LightSample s;
    if (light.type == LIGHT_DIRECTIONAL) {
        s.direction = -light.direction;
        s.distance_ = s.reach = 1.0e30;
        s.irradiance = light.intensity;
        return s;
    }
    const vec3 away = light.position - position;
    s.distance_ = max(length(away), 1e-6);
    s.reach = shadowRayLength(s.distance_, pointOffset(light.position), position);
    s.direction = away / s.distance_;
    s.irradiance = light.intensity / (s.distance_ * s.distance_);
    if (light.type == LIGHT_SPOT) s.irradiance *= spotFalloff(light, dot(-s.direction, light.direction));
    return s;
}

// The emissive triangle whose part of the power contains u.
uint pickEmitter(uint emitterCount, float u) {
    uint low = 0u, high = emitterCount - 1u;
    while (low < high) {
        const uint center = (low + high) / 2u;
        if (sceneEmitters.data[center].cumulativePower > u) high = center;
        else low = center + 1u;
    }
    return low;
}

// A point on an emissive triangle that is picked by power, uniform over the solid angle that the triangle takes, L angle / probability, or,
// where that is small, over its area: L cos' area / (d² probability).
LightSample sampleEmitters(uint emitterCount, vec3 position, float pick, vec2 u) {
    const GpuEmitter emitter = sceneEmitters.data[pickEmitter(emitterCount, pick)];
    const uvec3 corners = triangleVertices(emitter.triangle);
    const SphericalTriangle t = sphericalTriangle(vertexPosition(corners.x) - position, vertexPosition(corners.y) - position,
                                                  vertexPosition(corners.z) - position);
    const bool isWide = t.solidAngle > MIN_SOLID_ANGLE;
    const SurfacePoint e = surfacePoint(emitter.triangle, isWide ? sphericalTrianglePoint(t, u) : trianglePoint(u));
    const GpuMaterial m = sceneMaterials.data[e.material];
    const vec3 away = e.position - position;
    LightSample s;
    s.distance_ = max(length(away), 1e-6);
    s.reach = shadowRayLength(s.distance_, e.offset, position);
    s.direction = away / s.distance_;
    float cosine = -dot(e.geometricNormal, s.direction);
    if (m.doubleSided != 0u) cosine = abs(cosine);
    const float angle = isWide ? float(cosine > 0.0) * t.solidAngle : max(cosine, 0.0) * emitter.area / (s.distance_ * s.distance_);
    s.irradiance = emittedRadiance(m, e) * angle / emitter.probability;
    return s;
}

// A sample of a source of light for a surface: of punctual light `light`, or number `light` of `samples` samples of the emissive
// surfaces (by power and solid angle) or of the environment (by cosine about `normal`). `index` numbers the surface among those that
// share `seed`: neighbours in it complement each other. The irradiance is divided by `samples`, not multiplied by the cosine.
LightSample sampleSource(uint kind, uint light, uint samples, uint emitterCount, vec3 position, vec3 normal, uint index,
                         uint seed) {
    if (kind == SOURCE_PUNCTUAL) return samplePunctual(sceneLights.data[light], position);
    const uint point = index * samples + light;
    const vec2 u = sobol2(point, hashCombine(seed, 0u));
    LightSample s;
    if (kind == SOURCE_EMITTERS) {
        s = sampleEmitters(emitterCount, position, sobol2(point, hashCombine(seed, 1u)).x, u);
    } else {
        // Radiance * cos / (cos / pi).
        s.direction = cosineDirection(u, normal);
        s.distance_ = s.reach = 1.0e30;
        s.irradiance = environmentRadiance(s.direction) * PI / max(dot(normal, s.direction), 1e-6);
    }
    s.irradiance /= float(samples);
    return s;
}

#endif
