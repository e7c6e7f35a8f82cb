#include "passes/common/lights/light_sources.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "scene/region_split.h"
#include "trace/emission.h"

namespace voxray {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

float largest(glm::vec3 v) {
    return std::max({v.x, v.y, v.z});
}

}  // namespace

std::vector<LightSource> lightSources(const SceneState& state) {
    std::vector<LightSource> all;
    const auto add = [&](LightSource::Kind kind, uint32_t light, float power) {
        if (power > 0) all.push_back({kind, light, power});
    };
    const Geometry& g = state.geometry;
    const float radius = boundingSphere(g).radius;
    const float disc = kPi * radius * radius;
    for (uint32_t i = 0; i < state.lights.size(); ++i) {
        const Light& light = state.lights[i];
        const float solidAngleOrArea = light.type == LightType::Point  ? 4 * kPi
                                       : light.type == LightType::Spot ? 2 * kPi * (1 - std::cos(light.outerConeAngle))
                                                                       : disc;
        add(LightSource::Punctual, i, largest(light.intensity) * solidAngleOrArea);
    }
    float emitted = 0;
    const bool hasEmitters =
        std::ranges::any_of(state.scene->materials, [](const Material& m) { return m.emission != glm::vec3(0.0f); });
    for (size_t t = 0; hasEmitters && t < g.triangles.size(); ++t) {
        const float emission = largest(meanEmission(state, uint32_t(t)));
        const bool doubleSided = state.scene->materials[g.triangleMaterials[t]].doubleSided;
        if (emission > 0) emitted += emission * float(triangleArea(g, uint32_t(t))) * kPi * (doubleSided ? 2.0f : 1.0f);
    }
    add(LightSource::Emitters, 0, emitted);
    const Environment& e = state.scene->environment;
    const float peak = e.map ? *std::max_element(e.map->data.begin(), e.map->data.end()) : 1.0f;
    add(LightSource::Environment, 0, largest(e.radiance) * peak * 4 * kPi * disc);
    return all;
}

std::vector<LightSource> requireLightSources(const SceneState& state, const std::string& pass) {
    std::vector<LightSource> all = lightSources(state);
    if (all.empty())
        throw Error(
            "{}: the scene has no lights, emissive surfaces or environment; write some into 'scene', as in lights: "
            "[{{point: [0, 2, 0], intensity: 5}}], and leave 'keep_file_lights' true for its own",
            pass);
    return all;
}

std::vector<LightSource> shadowRaySources(const std::vector<LightSource>& sources, const SceneState& state,
                                          uint32_t exactLights) {
    const auto isLocal = [&](const LightSource& source) {
        return source.kind == LightSource::Punctual && state.lights[source.light].type != LightType::Directional;
    };
    if (std::ranges::count_if(sources, isLocal) <= ptrdiff_t(exactLights)) return sources;
    std::vector<LightSource> joined{{LightSource::Tree, 0, 0}};
    for (const LightSource& source : sources) {
        if (isLocal(source) || source.kind == LightSource::Emitters)
            joined[0].power += source.power;
        else
            joined.push_back(source);
    }
    return joined;
}

double totalPower(const std::vector<LightSource>& sources) {
    double watts = 0;
    for (const LightSource& source : sources) watts += source.power;
    return watts;
}

float meanIrradiance(const std::vector<LightSource>& sources, const Geometry& geometry) {
    const double area = surfaceArea(geometry);
    return area > 0 ? float(totalPower(sources) / area) : 0.0f;
}

float radianceUnit(const SceneState& state) {
    const float typical = meanIrradiance(lightSources(state), state.geometry);
    return typical > 0 ? std::exp2(std::floor(std::log2(typical))) : 1.0f;
}

BoundingSphere boundingSphere(const Geometry& geometry) {
    const auto [low, high] = geometry.region;
    const glm::vec3 center = 0.5f * (low + high);
    const auto larger = [](float radius) { return radius * 1.001f + 1e-6f; };
    const glm::vec3 farthest = glm::max(center - geometry.boundsMin, geometry.boundsMax - center);
    return {center, larger(0.5f * glm::length(high - low)), larger(glm::length(farthest))};
}

}  // namespace voxray
