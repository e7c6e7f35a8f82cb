// Samples of light sources for direct light at a point.
#ifndef VOXRAY_LIGHTS_GLSL
#define VOXRAY_LIGHTS_GLSL

#include "shaders/lights/environment_map.glsl"
#include "shaders/lights/light_sampling_types.h"
#include "shaders/lights/spherical_triangle.glsl"
#include "shaders/scene/light_tree.glsl"
#include "shaders/scene/sampling.glsl"
#include "shaders/scene/scene.glsl"
#include "shaders/scene/specular.glsl"

// As LightSource::Kind in passes/common/lights/light_sources.h.
#define SOURCE_PUNCTUAL 0u
#define SOURCE_EMITTERS 1u
#define SOURCE_ENVIRONMENT 2u
#define SOURCE_TREE 3u  // Emissive surfaces, point and spot lights together.

struct LightSample {
    vec3 direction;    // Towards the light, unit length.
    float distance_;   // m
    float reach;       // Length of the shadow ray, m: it ends in front of the light's surface.
    vec3 irradiance;   // At normal incidence, over the sample's probability density, W/m².
    float solidAngle;  // One over that density, sr; 0 for a punctual light.
    float height;      // Distance from the plane of an emissive surface, m; of other sources 1e30.
};

// Point: I / d²; spot: that times its falloff; directional: E.
LightSample samplePunctual(GpuLight light, vec3 position) {
    LightSample s;
    s.solidAngle = 0.0;
    s.height = 1.0e30;
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
        if (sceneEmitters.data[center].cumulativePower > u)
            high = center;
        else
            low = center + 1u;
    }
    return low;
}

// A point on an emissive triangle: uniform over the solid angle of the triangle; where that is small, uniform over its
// area, with a solid angle of cos' area / d².
LightSample sampleEmitter(GpuEmitter emitter, vec3 position, vec2 u) {
    const uvec3 corners = triangleVertices(emitter.triangle);
    const vec3 p0 = vertexPosition(corners.x), p1 = vertexPosition(corners.y), p2 = vertexPosition(corners.z);
    const SphericalTriangle t = sphericalTriangle(p0 - position, p1 - position, p2 - position);
    const bool isWide = t.solidAngle > MIN_SOLID_ANGLE;
    const vec2 w = isWide ? sphericalTrianglePoint(t, u) : trianglePoint(u);
    const vec3 point = interpolate(vec3(1.0 - w.x - w.y, w), p0, p1, p2), n = normalize(cross(p1 - p0, p2 - p0));
    const GpuMaterial m = sceneMaterials.data[triangleMaterial(emitter.triangle)];
    const vec3 toLight = point - position;
    LightSample s;
    s.distance_ = max(length(toLight), 1e-6);
    s.reach = shadowRayLength(s.distance_, max(planeOffset(p0, p1, p2, n), pointOffset(point)), position);
    s.direction = toLight / s.distance_;
    float cosine = -dot(n, s.direction);
    if (m.doubleSided != 0u) cosine = abs(cosine);
    s.height = max(s.distance_ * abs(cosine), 1e-6);
    s.solidAngle =
        isWide ? float(cosine > 0.0) * t.solidAngle : max(cosine, 0.0) * emitter.area / (s.distance_ * s.distance_);
    s.irradiance = vec3(0.0);
    if (s.solidAngle > 0.0) {
        const bool isEven = m.emissiveTexture.texture == NO_TEXTURE && m.alphaMode != ALPHA_MASK;
        s.irradiance = s.solidAngle * (isEven ? m.emission : emittedRadiance(m, surfacePoint(emitter.triangle, w)));
    }
    return s;
}

// A surface point that lights are sampled for, and how it reflects.
struct Receiver {
    vec3 position;    // m
    vec3 normal;      // For shading, unit length.
    vec3 faceNormal;  // Geometric, on the same side.
    vec3 out_;        // Towards the viewer, unit length.
    vec3 diffuse;     // Albedo.
    Specular specular;
};

// One that reflects all light by Lambert's law. `normal` is also the geometric normal.
Receiver whiteReceiver(vec3 position, vec3 normal) {
    return Receiver(position, normal, normal, normal, vec3(1.0), Specular(vec3(0.0), 0.0, 1.0, 0.0, 0.0));
}

// How a source is sampled.
struct SourceSampling {
    uint samples;     // Of the source, for each point.
    uint candidates;  // For each sample; at most MAX_LIGHT_CANDIDATES.
    uint emitterCount;
    uint emitterRoot;  // Of the light tree.
};

// Whether the light tree picks the light of a sample. If there are no more emitters than candidates, each is one.
bool isPickedByTree(uint kind, SourceSampling sampling) {
    return kind == SOURCE_TREE || (kind == SOURCE_EMITTERS && sampling.emitterCount > sampling.candidates);
}

// Candidates for a sample. What the tree picks is the only one: other descents cost more than they gain. So it is with a
// constant environment, which is distributed by cosine.
uint candidateCount(uint kind, SourceSampling sampling) {
    if (isPickedByTree(kind, sampling)) return 1u;
    if (kind == SOURCE_EMITTERS) return sampling.emitterCount;
    return hasEnvironmentMap() ? sampling.candidates : 1u;
}

// A light in the numbers of pickLight(), and its probability; 0: none.
struct PickedLight {
    uint light;
    float probability;
};

LightSample samplePicked(PickedLight picked, vec3 position, vec2 u) {
    if (picked.probability == 0.0) return LightSample(vec3(0.0, 0.0, 1.0), 1.0e30, 1.0e30, vec3(0.0), 0.0, 1.0e30);
    LightSample s;
    if ((picked.light & LIGHT_TREE_PUNCTUAL) != 0u)
        s = samplePunctual(sceneLights.data[picked.light & LIGHT_TREE_INDEX], position);
    else
        s = sampleEmitter(sceneEmitters.data[picked.light], position, u);
    s.solidAngle /= picked.probability;
    s.irradiance /= picked.probability;
    return s;
}

// Environment candidate k of `count`: the first half is distributed as the map's radiance, the others by cosine, with
// the weights of the balance heuristic (Veach 1997). `point`: of the Sobol sequence of `seed`.
LightSample environmentCandidate(uint k, uint count, vec3 normal, uint point, uint seed) {
    const uint fromMap = count / 2u, byCosine = count - fromMap;
    LightSample s;
    float mapDensity = 0.0;
    if (k < fromMap) {
        s.direction = sampleEnvironmentMap(sobol2(point * fromMap + k, hashCombine(seed, 2u)), mapDensity);
    } else {
        s.direction = cosineDirection(sobol2(point * byCosine + k - fromMap, hashCombine(seed, 0u)), normal);
        if (fromMap > 0u) mapDensity = environmentMapDensity(s.direction);
    }
    const float cosineDensity = max(dot(normal, s.direction), 1e-6) / PI;
    s.distance_ = s.reach = s.height = 1.0e30;
    s.solidAngle = 1.0 / (float(fromMap) * mapDensity + float(byCosine) * cosineDensity);
    s.irradiance = environmentRadiance(s.direction) * s.solidAngle;
    return s;
}

// All candidates of lights take the same point of their triangles, so that samples are as even over each lamp as the
// Sobol sequence.
LightSample candidate(uint kind, uint k, uint count, PickedLight picked, Receiver r, uint point, uint seed) {
    if (kind == SOURCE_ENVIRONMENT) return environmentCandidate(k, count, r.normal, point, seed);
    return samplePicked(picked, r.position, sobol2(point, hashCombine(seed, 0u)));
}

// What the receiver reflects of an unoccluded sample: luminance of the light times that of the reflectance, so that it
// is positive for every color of light that some color of the receiver would reflect.
float reflectedLuminance(Receiver r, LightSample s) {
    const float cosine = dot(r.normal, s.direction);
    if (cosine <= 0.0 || dot(r.faceNormal, s.direction) <= 0.0) return 0.0;
    return luminance(reflectance(r.diffuse, r.specular, r.normal, r.out_, s.direction)) * luminance(s.irradiance) *
           cosine;
}

// A sample of a light source for a surface point: of punctual light `light`, or sample `light` of `sampling.samples`
// of the emissive surfaces, the light tree or the environment. One of its candidates is selected in proportion to
// reflectedLuminance(): resampled importance sampling (Talbot et al. 2005). `index` of the point selects its range of
// the Sobol sequence of `seed`. The irradiance is divided by the number of samples, and is without the cosine.
LightSample sampleSource(uint kind, uint light, SourceSampling sampling, Receiver r, uint index, uint seed) {
    if (kind == SOURCE_PUNCTUAL) return samplePunctual(sceneLights.data[light], r.position);
    const uint point = index * sampling.samples + light, count = candidateCount(kind, sampling);
    const vec2 choice = sobol2(point, hashCombine(seed, 1u));
    PickedLight picked = PickedLight(0u, 1.0);
    const bool isPicked = isPickedByTree(kind, sampling);
    if (isPicked) {
        float u = choice.x;
        picked.light = pickLight(kind == SOURCE_EMITTERS ? sampling.emitterRoot : 0u, r.position, r.faceNormal, 0.0, u,
                                 picked.probability);
    }
    uint selected = 0u;
    float weight = 1.0;
    if (count > 1u) {
        float reflected[MAX_LIGHT_CANDIDATES];
        float total = 0.0;
        for (uint k = 0u; k < count; ++k)
            total += reflected[k] =
                reflectedLuminance(r, candidate(kind, k, count, PickedLight(k, 1.0), r, point, seed));
        float rest = choice.y * total;
        for (uint k = 0u; k < count && rest >= 0.0; ++k) {
            if (reflected[k] > 0.0) selected = k;
            rest -= reflected[k];
        }
        weight = total > 0.0 ? total / reflected[selected] : 0.0;
    }
    if (!isPicked) picked.light = selected;
    LightSample s = candidate(kind, selected, count, picked, r, point, seed);
    s.solidAngle *= weight;
    s.irradiance *= weight / float(sampling.samples);
    return s;
}

#endif
