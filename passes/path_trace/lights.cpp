#include "passes/path_trace/lights.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "scene/outliers.h"

namespace voxray::path_trace {

namespace {

/// Angular falloff of a spot light, t² of KHR_lights_punctual. @param direction away from the light.
float spotFalloff(const Light& light, const glm::vec3& direction) {
    const float cosOuter = std::cos(light.outerConeAngle);
    const float range = std::max(0.001f, std::cos(light.innerConeAngle) - cosOuter);
    const float t = std::clamp((glm::dot(light.direction, direction) - cosOuter) / range, 0.0f, 1.0f);
    return t * t;
}

/// Whether triangle b completes triangle a to the parallelogram a.corner + s edge1 + t (edge2 - edge1), as
/// quads split into (0, 1, 2), (0, 2, 3) are.
bool completesParallelogram(const SurfaceTriangle& a, const SurfaceTriangle& b) {
    const float size = glm::length(a.edge2);
    return a.material == b.material && a.corner == b.corner && b.edge1 == a.edge2 &&
           glm::length(a.edge1 + b.edge2 - a.edge2) < 1e-5f * size;
}

double triangleArea(const SurfaceTriangle& t) {
    return 0.5 * glm::length(glm::cross(glm::dvec3(t.edge1), glm::dvec3(t.edge2)));
}

/// Mean luminance of a triangle's emission, by a grid of samples. A tenth of the largest sample is mixed in,
/// so that small lamps between samples get some power; reflection sampling finds what all samples miss.
double meanEmission(const SurfaceTable& surfaces, uint32_t triangle) {
    constexpr int kSamplesPerEdge = 8;
    double sum = 0.0, largest = 0.0;
    for (int i = 0; i < kSamplesPerEdge * kSamplesPerEdge; ++i) {
        const glm::vec2 barycentrics = uniformTriangle((float(i % kSamplesPerEdge) + 0.5f) / kSamplesPerEdge,
                                                       (float(i / kSamplesPerEdge) + 0.5f) / kSamplesPerEdge);
        const double value = luminance(surfaces.emission(triangle, barycentrics.x, barycentrics.y));
        sum += value;
        largest = std::max(largest, value);
    }
    return 0.9 * sum / (kSamplesPerEdge * kSamplesPerEdge) + 0.1 * largest;
}

}  // namespace

LightTable::LightTable(const SceneState& state, SurfaceTable& surfaces)
    : state_(&state), surfaces_(&surfaces), environment_(state.scene->environment) {
    // Power of punctual lights; a directional one lights the bounding sphere of most of the scene
    std::vector<double> power;
    const auto [low, high] = boundsWithoutOutliers(state.geometry);
    const double radius = 0.5 * double(glm::length(high - low));
    for (const Light& light : state.lights) {
        const double strength = luminance(light.intensity);
        switch (light.type) {
            case LightType::Point:
                power.push_back(strength * 4.0 * kPi);
                break;
            case LightType::Spot:
                power.push_back(strength * 2.0 * kPi * (1.0 - std::cos(light.outerConeAngle)));
                break;
            case LightType::Directional:
                power.push_back(strength * kPi * radius * radius);
                break;
        }
    }

    // Environment maps are sampled; a constant environment is found by reflection sampling
    environmentIndex_ = uint32_t(power.size());
    power.push_back(environment_.hasMap() && !environment_.isBlack()
                        ? environment_.meanLuminance() * 4.0 * kPi * kPi * radius * radius
                        : 0.0);

    // Emissive triangles; halves of a quad form one patch
    const size_t firstPatch = power.size();
    for (uint32_t i = 0; i < surfaces.triangleCount(); ++i) {
        const Material& m = state.scene->materials[state.geometry.triangleMaterials[i]];
        if (!(maxComponent(m.emission) > 0.0f)) continue;
        const SurfaceTriangle t = surfaces.triangle(i);
        double area = triangleArea(t);
        if (!(area > 0.0)) continue;
        const double emission = meanEmission(surfaces, i) * (m.doubleSided ? 2.0 : 1.0);
        if (!(emission > 0.0) && !surfaces.emissionVaries(t)) continue;
        Patch patch{i, false, 0.0f};
        const auto light = uint32_t(patches_.size());
        surfaces.setLight(i, light);
        if (!surfaces.emissionVaries(t) && i + 1 < surfaces.triangleCount() &&
            completesParallelogram(t, surfaces.triangle(i + 1))) {
            patch.isParallelogram = true;
            area *= 2.0;
            surfaces.setLight(++i, light);
        }
        patch.pdf = float(1.0 / area);
        patches_.push_back(patch);
        power.push_back(emission * area * kPi);
    }

    distribution_ = AliasTable(power);
    isSingle_ = std::count_if(power.begin(), power.end(), [](double p) { return p > 0.0; }) == 1;
    for (size_t i = 0; i < patches_.size(); ++i)
        patches_[i].pdf *= distribution_.empty() ? 0.0f : distribution_.probability(uint32_t(firstPatch + i));
}

LightSample LightTable::sample(const glm::vec3& from, float uLight, glm::vec2 u) const {
    const uint32_t i = distribution_.draw(uLight);
    if (i > environmentIndex_) return samplePatch(patches_[i - environmentIndex_ - 1], from, u);
    if (i < environmentIndex_) return samplePunctual(state_->lights[i], distribution_.probability(i), from);
    LightSample sample;
    sample.isInfinite = true;
    sample.direction = environment_.sample(u.x, u.y, sample.pdf);
    sample.pdf *= distribution_.probability(i);
    sample.radiance = environment_.radiance(sample.direction);
    return sample;
}

LightSample LightTable::samplePatch(const Patch& patch, const glm::vec3& from, glm::vec2 u) const {
    const SurfaceTriangle t = surfaces_->triangle(patch.triangle);
    const glm::vec2 barycentrics = patch.isParallelogram ? u : uniformTriangle(u.x, u.y);
    const glm::vec3 secondEdge = patch.isParallelogram ? t.edge2 - t.edge1 : t.edge2;
    const glm::vec3 point = t.corner + t.edge1 * barycentrics.x + secondEdge * barycentrics.y;
    const glm::vec3 toLight = point - from;
    const float distance2 = glm::dot(toLight, toLight);
    LightSample sample;
    if (!(distance2 > 0.0f)) return sample;
    sample.direction = toLight / std::sqrt(distance2);
    const float cosine = -glm::dot(t.normal, sample.direction);
    if (!surfaces_->emitsTowards(t, -sample.direction) || cosine == 0.0f) return sample;
    sample.pdf = patch.pdf * distance2 / std::fabs(cosine);
    sample.radiance = surfaces_->emission(patch.triangle, barycentrics.x, barycentrics.y);
    sample.target = point + t.normal * std::copysign(t.offsetAt(point), cosine);
    return sample;
}

LightSample LightTable::samplePunctual(const Light& light, float probability, const glm::vec3& from) const {
    LightSample sample;
    sample.isDelta = true;
    sample.pdf = probability;
    if (light.type == LightType::Directional) {
        sample.isInfinite = true;
        sample.direction = -light.direction;
        sample.radiance = light.intensity;
        return sample;
    }
    sample.target = light.position;
    const glm::vec3 toLight = light.position - from;
    const float distance2 = glm::dot(toLight, toLight);
    if (!(distance2 > 0.0f)) return {};
    sample.direction = toLight / std::sqrt(distance2);
    sample.radiance = light.intensity / distance2;
    if (light.type == LightType::Spot) sample.radiance *= spotFalloff(light, -sample.direction);
    return sample;
}

float LightTable::hitPdf(const SurfaceTriangle& triangle, const glm::vec3& direction, float distance) const {
    const float cosine = std::fabs(glm::dot(triangle.normal, direction));
    return cosine > 0.0f ? patches_[triangle.light].pdf * distance * distance / cosine : 0.0f;
}

float LightTable::environmentPdf(const glm::vec3& direction) const {
    if (!environment_.hasMap()) return 0.0f;
    return environment_.pdf(direction) * distribution_.probability(environmentIndex_);
}

}  // namespace voxray::path_trace
