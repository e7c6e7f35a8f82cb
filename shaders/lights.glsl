// Light samples as seen from a point.
#ifndef VOXRAY_LIGHTS_GLSL
#define VOXRAY_LIGHTS_GLSL

#include "shaders/sampling.glsl"
#include "shaders/scene.glsl"

struct LightSample {
    vec3 direction;   // Towards the light, unit length.
    float distance_;  // m
    vec3 irradiance;  // W/m² on a surface that faces the sample, divided by the density of picking it.
};

// Point: I / d²; spot: that times its falloff; directional: E.
LightSample samplePunctual(GpuLight light, vec3 position) {
    LightSample s;
    if (light.type == LIGHT_DIRECTIONAL) {
        s.direction = -light.direction;
        s.distance_ = 1.0e30;
        s.irradiance = light.intensity;
        return s;
    }
    const vec3 away = light.position - position;
    s.distance_ = max(length(away), 1e-6);
    s.direction = away / s.distance_;
    s.irradiance = light.intensity / (s.distance_ * s.distance_);
    if (light.type == LIGHT_SPOT) s.irradiance *= spotFalloff(light, dot(-s.direction, light.direction));
    return s;
}

// The emissive triangle whose share of the power contains u.
uint pickEmitter(uint emitterCount, float u) {
    uint low = 0u, high = emitterCount - 1u;
    while (low < high) {
        const uint middle = (low + high) / 2u;
        if (sceneEmitters.data[middle].cumulativePower > u) high = middle;
        else low = middle + 1u;
    }
    return low;
}

// A point on an emissive triangle, picked by power and uniform over its area: L cos' area / (d² probability).
LightSample sampleEmitters(uint emitterCount, vec3 position, float pick, vec2 u) {
    const GpuEmitter emitter = sceneEmitters.data[pickEmitter(emitterCount, pick)];
    const SurfacePoint e = surfacePoint(emitter.triangle, trianglePoint(u));
    const GpuMaterial m = sceneMaterials.data[e.material];
    const vec3 away = e.position - position;
    LightSample s;
    s.distance_ = max(length(away), 1e-6);
    s.direction = away / s.distance_;
    float cosine = -dot(e.geometricNormal, s.direction);
    if (m.doubleSided != 0u) cosine = abs(cosine);
    s.irradiance = emission(m, e, 0.0) * max(cosine, 0.0) * emitter.area /
                   (s.distance_ * s.distance_ * emitter.probability);
    return s;
}

#endif
