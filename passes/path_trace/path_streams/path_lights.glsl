// Sampling of one of all lights, and the density of that, as the host's passes/path_trace/lights.h has them.
#ifndef VOXRAY_PATH_LIGHTS_GLSL
#define VOXRAY_PATH_LIGHTS_GLSL

#include "path_types.h"
#include "shaders/lights/environment_map.glsl"
#include "shaders/scene/scene.glsl"

layout(scalar) readonly buffer LightBins { LightBin data[]; } lightBins;
layout(scalar) readonly buffer LightPatches { LightPatch data[]; } lightPatches;

// Unoccluded light at a point.
struct LightSample {
    vec3 direction;  // Unit length, towards the light.
    vec3 toLight;    // To where a shadow ray ends, m; of a light at infinity the direction.
    bool isInfinite;
    bool isDelta;    // No other technique samples this light.
    vec3 radiance;   // Irradiance of a delta light, else radiance.
    float pdf;       // 1/sr, or the choice's probability alone for a delta; 0: no light.
};

// Draws a light in proportion to its power.
uint drawLight(PathLights lights, float u) {
    const float scaled = u * float(lights.count);
    const uint i = min(uint(scaled), lights.count - 1u);
    return scaled - float(i) < lightBins.data[i].threshold ? i : lightBins.data[i].alias;
}

LightSample samplePunctualLight(GpuLight light, float probability, vec3 position) {
    LightSample s = LightSample(-light.direction, -light.direction, true, true, light.intensity, probability);
    if (light.type == LIGHT_DIRECTIONAL) return s;
    s.isInfinite = false;
    s.toLight = light.position - position;
    const float distance2 = dot(s.toLight, s.toLight);
    if (!(distance2 > 0.0)) s.pdf = 0.0;
    s.direction = s.toLight / sqrt(distance2);
    s.radiance = light.intensity / distance2;
    if (light.type == LIGHT_SPOT) s.radiance *= spotFalloff(light, dot(-s.direction, light.direction));
    return s;
}

// A uniform point of a patch.
LightSample samplePatch(LightPatch patch_, vec3 position, vec2 u) {
    const uvec3 corners = triangleVertices(patch_.triangle);
    const vec3 p0 = vertexPosition(corners.x), p1 = vertexPosition(corners.y), p2 = vertexPosition(corners.z);
    const bool isParallelogram = patch_.isParallelogram != 0u;
    const vec2 w = isParallelogram ? u : trianglePoint(u);
    const vec3 point = p0 + (p1 - p0) * w.x + (isParallelogram ? p2 - p1 : p2 - p0) * w.y;
    const vec3 n = normalize(cross(p1 - p0, p2 - p0)), toPoint = point - position;
    const float distance2 = dot(toPoint, toPoint);
    LightSample s = LightSample(vec3(0.0), vec3(0.0), false, false, vec3(0.0), 0.0);
    if (!(distance2 > 0.0)) return s;
    s.direction = toPoint / sqrt(distance2);
    const float cosine = -dot(n, s.direction);
    const GpuMaterial m = sceneMaterials.data[triangleMaterial(patch_.triangle)];
    if (cosine == 0.0 || (cosine < 0.0 && m.doubleSided == 0u)) return s;
    s.pdf = patch_.pdf * distance2 / abs(cosine);
    const bool isEven = m.emissiveTexture.texture == NO_TEXTURE && m.alphaMode != ALPHA_MASK;
    s.radiance = isEven ? m.emission : emittedRadiance(m, surfacePoint(patch_.triangle, w));
    const float offset = max(planeOffset(p0, p1, p2, n), pointOffset(point));
    s.toLight = toPoint + n * (cosine < 0.0 ? -offset : offset);
    return s;
}

// Samples a light by `uLight`, and by `u` a point on it, for a surface at `position`. A map of the environment is
// sampled; a constant environment is left to reflection sampling, which finds it everywhere.
LightSample sampleLight(PathLights lights, float uLight, vec2 u, vec3 position) {
    const uint i = drawLight(lights, uLight);
    if (i > lights.environment) return samplePatch(lightPatches.data[i - lights.environment - 1u], position, u);
    const float probability = lightBins.data[i].probability;
    if (i < lights.environment) return samplePunctualLight(sceneLights.data[i], probability, position);
    LightSample s = LightSample(vec3(0.0), vec3(0.0), true, false, vec3(0.0), 0.0);
    s.toLight = s.direction = sampleEnvironmentMap(u, s.pdf);
    s.pdf *= probability;
    s.radiance = environmentRadiance(s.direction);
    return s;
}

// Density of sampleLight(), 1/sr, for a patch that a ray hits at `distance_`. `cosine`: of direction and the normal.
float patchPdf(uint patch_, float cosine, float distance_) {
    return cosine != 0.0 ? lightPatches.data[patch_].pdf * distance_ * distance_ / abs(cosine) : 0.0;
}

// The same for the environment.
float environmentPdf(PathLights lights, vec3 direction) {
    if (!hasEnvironmentMap() || lights.count == 0u) return 0.0;
    return environmentMapDensity(direction) * lightBins.data[lights.environment].probability;
}

// Weight of a sample with density `pdf` where another technique has `otherPdf`: power heuristic with exponent 2 (Veach
// 1997, section 9.2).
float misWeight(float pdf, float otherPdf) {
    const float ratio = otherPdf / pdf;
    return 1.0 / (1.0 + ratio * ratio);
}

#endif
