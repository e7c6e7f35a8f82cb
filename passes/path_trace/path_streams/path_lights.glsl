// Sampling of one of all lights, and the density of that, as the host's passes/path_trace/lights.h has them.
#ifndef VOXRAY_PATH_LIGHTS_GLSL
#define VOXRAY_PATH_LIGHTS_GLSL

#include "path_types.h"
#include "shaders/lights/environment_map.glsl"
#include "shaders/scene/light_tree_types.h"
#include "shaders/scene/scene.glsl"

layout(scalar) readonly buffer PathLightTree { LightTreeNode data[]; } pathLightTree;
#define LIGHT_TREE pathLightTree
#include "shaders/scene/light_tree.glsl"

layout(scalar) readonly buffer InfiniteLights { uint data[]; } infiniteLights;
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

// A surface that lights are sampled for.
struct LightReceiver {
    vec3 position;  // Of the origin of its rays.
    vec3 faceNormal;
};

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
LightSample samplePatch(LightPatch patch_, float probability, vec3 position, vec2 u) {
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
    s.pdf = patch_.inverseArea * probability * distance2 / abs(cosine);
    const bool isEven = m.emissiveTexture.texture == NO_TEXTURE && m.alphaMode != ALPHA_MASK;
    s.radiance = isEven ? m.emission : emittedRadiance(m, surfacePoint(patch_.triangle, w));
    const float offset = max(planeOffset(p0, p1, p2, n), pointOffset(point));
    s.toLight = toPoint + n * (cosine < 0.0 ? -offset : offset);
    return s;
}

// Estimated irradiance of an infinite light.
float infiniteIrradiance(PathLights lights, uint infinite, vec3 faceNormal) {
    if (infinite == ENVIRONMENT_LIGHT) return lights.environmentIrradiance;
    const GpuLight light = sceneLights.data[infinite];
    return luminance(light.intensity) * max(-dot(light.direction, faceNormal), 0.0);
}

// The same of all infinite lights.
float infiniteIrradiance(PathLights lights, vec3 faceNormal) {
    float sum = 0.0;
    for (uint i = 0u; i < lights.infiniteLights; ++i)
        sum += infiniteIrradiance(lights, infiniteLights.data[i], faceNormal);
    return sum;
}

// Samples an infinite light by `uLight`, which the choice of infinite lights left over, and by `u` a direction.
LightSample sampleInfinite(PathLights lights, float probability, float uLight, vec2 u, LightReceiver to) {
    const float total = infiniteIrradiance(lights, to.faceNormal);
    float rest = uLight * total, ofChosen = 0.0;
    uint chosen = ENVIRONMENT_LIGHT;
    for (uint i = 0u; i < lights.infiniteLights && rest >= ofChosen; ++i) {
        const float next = infiniteIrradiance(lights, infiniteLights.data[i], to.faceNormal);
        if (!(next > 0.0)) continue;
        rest -= ofChosen;
        ofChosen = next;
        chosen = infiniteLights.data[i];
    }
    probability *= ofChosen / total;
    if (chosen != ENVIRONMENT_LIGHT) return samplePunctualLight(sceneLights.data[chosen], probability, to.position);
    LightSample s = LightSample(vec3(0.0), vec3(0.0), true, false, vec3(0.0), 0.0);
    s.toLight = s.direction = sampleEnvironmentMap(u, s.pdf);
    s.pdf *= probability;
    s.radiance = environmentRadiance(s.direction);
    return s;
}

// Samples a light by `uLight`, and by `u` a point on it. A map of the environment is sampled; a constant environment is
// left to reflection sampling, which finds it everywhere.
LightSample sampleLight(PathLights lights, float uLight, vec2 u, LightReceiver to) {
    const float beside = infiniteIrradiance(lights, to.faceNormal);
    uint picked = LIGHT_TREE_BESIDE;
    float probability = beside > 0.0 ? 1.0 : 0.0;
    if (lights.treeNodes > 0u)
        picked = pickLight(0u, to.position, to.faceNormal, beside / lights.treeIntensity, uLight, probability);
    if (!(probability > 0.0)) return LightSample(vec3(0.0), vec3(0.0), false, false, vec3(0.0), 0.0);
    if (picked == LIGHT_TREE_BESIDE) return sampleInfinite(lights, probability, uLight, u, to);
    if (picked >= lights.punctualLights)
        return samplePatch(lightPatches.data[picked - lights.punctualLights], probability, to.position, u);
    return samplePunctualLight(sceneLights.data[picked], probability, to.position);
}

// Density of sampleLight(), 1/sr, for a patch that a ray hits at `distance_`. `cosine`: of direction and the normal.
float patchPdf(PathLights lights, uint patch_, float cosine, float distance_, LightReceiver to) {
    const LightPatch p = lightPatches.data[patch_];
    if (cosine == 0.0 || p.leaf == NO_LEAF) return 0.0;
    const float beside = infiniteIrradiance(lights, to.faceNormal) / lights.treeIntensity;
    const float probability = lightProbability(0u, p.leaf, to.position, to.faceNormal, beside);
    return p.inverseArea * probability * distance_ * distance_ / abs(cosine);
}

// The same for the environment.
float environmentPdf(PathLights lights, vec3 direction, LightReceiver to) {
    if (!hasEnvironmentMap() || !(lights.environmentIrradiance > 0.0)) return 0.0;
    float total = infiniteIrradiance(lights, to.faceNormal);
    if (lights.treeNodes > 0u)
        total += lights.treeIntensity * childrenImportance(0u, to.position, to.faceNormal);
    return environmentMapDensity(direction) * lights.environmentIrradiance / total;
}

// Weight of a sample with density `pdf` where another technique has `otherPdf`: power heuristic with exponent 2 (Veach
// 1997, section 9.2).
float misWeight(float pdf, float otherPdf) {
    const float ratio = otherPdf / pdf;
    return 1.0 / (1.0 + ratio * ratio);
}

#endif
