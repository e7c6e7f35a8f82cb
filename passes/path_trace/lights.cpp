#include "passes/path_trace/lights.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "scene/outliers.h"

namespace voxray::path_trace {

namespace {

/// Falloff of a spot towards a direction that leaves it: t², KHR_lights_punctual.
float spotFalloff(const Light& light, const glm::vec3& direction) {
    const float cosOuter = std::cos(light.outerConeAngle);
    const float range = std::max(0.001f, std::cos(light.innerConeAngle) - cosOuter);
    const float t = std::clamp((glm::dot(light.direction, direction) - cosOuter) / range, 0.0f, 1.0f);
    return t * t;
}

/// Whether triangle b completes triangle a to the parallelogram a.corner + s edge1 + t (edge2 - edge1), which
/// is what quads split as (0, 1, 2), (0, 2, 3) are.
bool completesParallelogram(const SurfaceTriangle& a, const SurfaceTriangle& b) {
    const float size = glm::length(a.edge2);
    return a.material == b.material && a.corner == b.corner && b.edge1 == a.edge2 &&
           glm::length(a.edge1 + b.edge2 - a.edge2) < 1e-5f * size;
}

double areaOf(const SurfaceTriangle& t) {
    return 0.5 * glm::length(glm::cross(glm::dvec3(t.edge1), glm::dvec3(t.edge2)));
}

/// Mean luminance of what a triangle emits. A part of the brightest sample is mixed in, so that a lamp
/// between the samples still gets its part; reflection sampling meets what all samples miss.
double meanEmission(const SurfaceTable& surfaces, uint32_t triangle) {
    constexpr int kSide = 8;
    double sum = 0.0, largest = 0.0;
    for (int i = 0; i < kSide * kSide; ++i) {
        const glm::vec2 b =
            uniformTriangle((float(i % kSide) + 0.5f) / kSide, (float(i / kSide) + 0.5f) / kSide);
        const double value = luminance(surfaces.emission(triangle, b.x, b.y));
        sum += value;
        largest = std::max(largest, value);
    }
    return 0.9 * sum / (kSide * kSide) + 0.1 * largest;
}

}  // namespace

LightTable::LightTable(const SceneState& state, SurfaceTable& surfaces)
    : state_(&state), surfaces_(&surfaces), environment_(state.scene->environment) {
    // Power of the punctual lights. A directional one shines on the sphere round most of the scene.
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

    // Environment maps are sampled; a constant one is met by reflection sampling.
    environmentChoice_ = uint32_t(power.size());
    power.push_back(environment_.hasMap() && !environment_.isBlack()
                        ? environment_.meanLuminance() * 4.0 * kPi * kPi * radius * radius
                        : 0.0);

    // Emissive triangles; halves of a quad are joined.
    const size_t firstPatch = power.size();
    for (uint32_t i = 0; i < surfaces.triangleCount(); ++i) {
        const Material& m = state.scene->materials[state.geometry.triangleMaterials[i]];
        if (!(maxComponent(m.emission) > 0.0f)) continue;
        const SurfaceTriangle t = surfaces.triangle(i);
        double area = areaOf(t);
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

    choice_ = AliasTable(power);
    single_ = std::count_if(power.begin(), power.end(), [](double p) { return p > 0.0; }) == 1;
    for (size_t i = 0; i < patches_.size(); ++i)
        patches_[i].pdf *= choice_.empty() ? 0.0f : choice_.probability(uint32_t(firstPatch + i));
}

LightSample LightTable::sample(const glm::vec3& from, float choice, glm::vec2 place) const {
    const uint32_t i = choice_.draw(choice);
    if (i > environmentChoice_) return samplePatch(patches_[i - environmentChoice_ - 1], from, place);
    if (i < environmentChoice_) return samplePunctual(state_->lights[i], choice_.probability(i), from);
    LightSample sample;
    sample.isInfinite = true;
    sample.direction = environment_.sample(place.x, place.y, sample.pdf);
    sample.pdf *= choice_.probability(i);
    sample.radiance = environment_.radiance(sample.direction);
    return sample;
}

LightSample LightTable::samplePatch(const Patch& patch, const glm::vec3& from, glm::vec2 place) const {
    const SurfaceTriangle t = surfaces_->triangle(patch.triangle);
    const glm::vec2 b = patch.isParallelogram ? place : uniformTriangle(place.x, place.y);
    const glm::vec3 side = patch.isParallelogram ? t.edge2 - t.edge1 : t.edge2;
    const glm::vec3 point = t.corner + t.edge1 * b.x + side * b.y;
    const glm::vec3 way = point - from;
    const float distance2 = glm::dot(way, way);
    LightSample sample;
    if (!(distance2 > 0.0f)) return sample;
    sample.direction = way / std::sqrt(distance2);
    const float cosine = -glm::dot(t.normal, sample.direction);
    if (!surfaces_->emitsTowards(t, -sample.direction) || cosine == 0.0f) return sample;
    sample.pdf = patch.pdf * distance2 / std::fabs(cosine);
    sample.radiance = surfaces_->emission(patch.triangle, b.x, b.y);
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
    const glm::vec3 way = light.position - from;
    const float distance2 = glm::dot(way, way);
    if (!(distance2 > 0.0f)) return {};
    sample.direction = way / std::sqrt(distance2);
    sample.radiance = light.intensity / distance2;
    if (light.type == LightType::Spot) sample.radiance *= spotFalloff(light, -sample.direction);
    return sample;
}

float LightTable::pdfOfHit(const SurfaceTriangle& triangle, const glm::vec3& direction,
                           float distance) const {
    const float cosine = std::fabs(glm::dot(triangle.normal, direction));
    return cosine > 0.0f ? patches_[triangle.light].pdf * distance * distance / cosine : 0.0f;
}

float LightTable::pdfOfEnvironment(const glm::vec3& direction) const {
    if (!environment_.hasMap()) return 0.0f;
    return environment_.pdf(direction) * choice_.probability(environmentChoice_);
}

}  // namespace voxray::path_trace
