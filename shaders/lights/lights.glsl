// Samples of light sources for direct light at a point.
#ifndef VOXRAY_LIGHTS_GLSL
#define VOXRAY_LIGHTS_GLSL

#include "shaders/scene/sampling.glsl"
#include "shaders/lights/spherical_triangle.glsl"
#include "shaders/scene/scene.glsl"

// As LightSource::Kind in passes/common/lights/light_sources.h.
#define SOURCE_PUNCTUAL 0u
#define SOURCE_EMITTERS 1u
#define SOURCE_ENVIRONMENT 2u

struct LightSample {
    vec3 direction;   // Towards the light, unit length.
    float distance_;  // m
    float reach;      // Length of the shadow ray, m: it ends in front of the light's surface.
    vec3 irradiance;  // At normal incidence, over the sample's probability density, W/m².
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
    const vec3 toLight = light.position - position;
    s.distance_ = max(length(toLight), 1e-6);
    s.reach = shadowRayLength(s.distance_, pointOffset(light.position), position);
    s.direction = toLight / s.distance_;
    s.irradiance = light.intensity / (s.distance_ * s.distance_);
    if (light.type == LIGHT_SPOT) s.irradiance *= spotFalloff(light, dot(-s.direction, light.direction));
    return s;
}

// Picks an emissive triangle in proportion to its power.
uint pickEmitter(uint emitterCount, float u) {
    uint low = 0u, high = emitterCount - 1u;
    while (low < high) {
        const uint center = (low + high) / 2u;
        if (sceneEmitters.data[center].cumulativePower > u) high = center;
        else low = center + 1u;
    }
    return low;
}

// A point on an emissive triangle, which is picked by power. Uniform over the triangle's solid angle: irradiance
// L * solid angle / probability; where that angle is small, uniform over its area: L cos' area / (d² probability).
LightSample sampleEmitters(uint emitterCount, vec3 position, float pick, vec2 u) {
    const GpuEmitter emitter = sceneEmitters.data[pickEmitter(emitterCount, pick)];
    const uvec3 corners = triangleVertices(emitter.triangle);
    const SphericalTriangle t =
        sphericalTriangle(vertexPosition(corners.x) - position, vertexPosition(corners.y) - position,
                          vertexPosition(corners.z) - position);
    const bool isWide = t.solidAngle > MIN_SOLID_ANGLE;
    const SurfacePoint e = surfacePoint(emitter.triangle, isWide ? sphericalTrianglePoint(t, u) : trianglePoint(u));
    const GpuMaterial m = sceneMaterials.data[e.material];
    const vec3 toLight = e.position - position;
    LightSample s;
    s.distance_ = max(length(toLight), 1e-6);
    s.reach = shadowRayLength(s.distance_, e.offset, position);
    s.direction = toLight / s.distance_;
    float cosine = -dot(e.geometricNormal, s.direction);
    if (m.doubleSided != 0u) cosine = abs(cosine);
    const float angle =
        isWide ? float(cosine > 0.0) * t.solidAngle : max(cosine, 0.0) * emitter.area / (s.distance_ * s.distance_);
    s.irradiance = emittedRadiance(m, e) * angle / emitter.probability;
    return s;
}

// A sample of a light source for a surface point: of punctual light `light`, or sample `light` of `samples` samples of
// the emissive surfaces (by power and solid angle) or of the environment (by cosine about `normal`). `index` of the
// point selects its range of the Sobol sequence of `seed`. The irradiance is divided by `samples`, and is without the
// cosine.
LightSample sampleSource(uint kind, uint light, uint samples, uint emitterCount, vec3 position, vec3 normal, uint index,
                         uint seed) {
    if (kind == SOURCE_PUNCTUAL) return samplePunctual(sceneLights.data[light], position);
    const uint point = index * samples + light;
    const vec2 u = sobol2(point, hashCombine(seed, 0u));
    LightSample s;
    if (kind == SOURCE_EMITTERS) {
        s = sampleEmitters(emitterCount, position, sobol2(point, hashCombine(seed, 1u)).x, u);
    } else {
        // Radiance over the density per projected solid angle, 1 / pi; without the cosine.
        s.direction = cosineDirection(u, normal);
        s.distance_ = s.reach = 1.0e30;
        s.irradiance = environmentRadiance(s.direction) * PI / max(dot(normal, s.direction), 1e-6);
    }
    s.irradiance /= float(samples);
    return s;
}

#endif
