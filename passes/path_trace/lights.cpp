#include "passes/path_trace/lights.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <span>

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
    std::vector<BoundedLight> bounded;
    for (uint32_t i = 0; i < state.lights.size(); ++i) {
        if (const auto light = boundedLight(state.lights[i], i)) bounded.push_back(*light);
        if (state.lights[i].type == LightType::Directional && luminance(state.lights[i].intensity) > 0.0f)
            infinite_.push_back(i);
    }
    // Environment maps are sampled; a constant environment is found by reflection sampling
    if (environment_.hasMap() && !environment_.isBlack()) infinite_.push_back(kEnvironment);

    const size_t firstPatch = bounded.size();
    const std::vector<BoundedLight> patches = addPatches();
    bounded.insert(bounded.end(), patches.begin(), patches.end());
    tree_ = LightTree(bounded);
    for (size_t i = 0; i < patches.size(); ++i) patches_[patches[i].id - idOf(0)].leaf = tree_.leaf(firstPatch + i);
}

std::vector<BoundedLight> LightTable::addPatches() {
    std::vector<BoundedLight> bounded;
    const SurfaceTable& surfaces = *surfaces_;
    const Geometry& geometry = state_->geometry;
    for (uint32_t i = 0; i < surfaces.triangleCount(); ++i) {
        const Material& m = state_->scene->materials[geometry.triangleMaterials[i]];
        if (!(maxComponent(m.emission) > 0.0f)) continue;
        const SurfaceTriangle t = surfaces.triangle(i);
        const double area = triangleArea(t);
        if (!(area > 0.0)) continue;
        const bool varies = surfaces.emissionVaries(t);
        const double radiance = meanEmission(surfaces, i);
        if (!(radiance > 0.0) && !varies) continue;
        // Halves of a quad form one patch
        const bool isParallelogram =
            !varies && i + 1 < surfaces.triangleCount() && completesParallelogram(t, surfaces.triangle(i + 1));
        const auto patch = uint32_t(patches_.size());
        const double patchArea = isParallelogram ? 2.0 * area : area;
        patches_.push_back({i, isParallelogram, float(1.0 / patchArea), kNoLeaf});
        surfaces_->setLight(i, patch);
        // Where samples miss all light, only reflection sampling finds it
        if (radiance > 0.0) {
            const glm::vec3 corners[] = {t.corner, t.corner + t.edge1, t.corner + t.edge2,
                                         t.corner + t.edge2 - t.edge1};
            bounded.push_back(boundedLight(std::span(corners).first(isParallelogram ? 4 : 3), t.normal, patchArea,
                                           radiance, m.doubleSided, idOf(patch)));
        }
        if (isParallelogram) surfaces_->setLight(++i, patch);
    }
    return bounded;
}

float LightTable::environmentIrradiance() const {
    return kPi * environment_.meanLuminance();
}

float LightTable::irradiance(uint32_t infinite, const Receiver& to) const {
    if (infinite == kEnvironment) return environmentIrradiance();
    const Light& light = state_->lights[infinite];
    return luminance(light.intensity) * std::max(-glm::dot(light.direction, to.faceNormal), 0.0f);
}

float LightTable::infiniteIrradiance(const Receiver& to) const {
    float sum = 0.0f;
    for (const uint32_t infinite : infinite_) sum += irradiance(infinite, to);
    return sum;
}

LightSample LightTable::sample(const Receiver& to, float uLight, glm::vec2 u) const {
    const LightTree::Pick pick = tree_.pick(treeReceiver(to), uLight);
    if (!(pick.probability > 0.0f)) return {};
    const size_t lights = state_->lights.size();
    if (pick.id == LightTree::kBeside) return sampleInfinite(to, pick, u);
    return pick.id < lights ? samplePunctual(state_->lights[pick.id], pick.probability, to.position)
                            : samplePatch(patches_[pick.id - lights], pick.probability, to.position, u);
}

LightSample LightTable::sampleInfinite(const Receiver& to, const LightTree::Pick& pick, glm::vec2 u) const {
    const float total = infiniteIrradiance(to);
    float rest = pick.u * total, ofChosen = 0.0f;
    uint32_t chosen = kEnvironment;
    for (const uint32_t infinite : infinite_) {
        if (rest < ofChosen) break;
        const float next = irradiance(infinite, to);
        if (!(next > 0.0f)) continue;
        rest -= ofChosen;
        ofChosen = next;
        chosen = infinite;
    }
    const float probability = pick.probability * ofChosen / total;
    return chosen == kEnvironment ? sampleEnvironment(probability, u)
                                  : samplePunctual(state_->lights[chosen], probability, to.position);
}

LightSample LightTable::sampleEnvironment(float probability, glm::vec2 u) const {
    LightSample sample;
    sample.isInfinite = true;
    sample.direction = environment_.sample(u.x, u.y, sample.pdf);
    sample.pdf *= probability;
    sample.radiance = environment_.radiance(sample.direction);
    return sample;
}

LightSample LightTable::samplePatch(const Patch& patch, float probability, const glm::vec3& from, glm::vec2 u) const {
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
    sample.pdf = patch.inverseArea * probability * distance2 / std::fabs(cosine);
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

float LightTable::hitPdf(const Receiver& to, const SurfaceTriangle& triangle, const glm::vec3& direction,
                         float distance) const {
    const Patch& patch = patches_[triangle.light];
    const float cosine = std::fabs(glm::dot(triangle.normal, direction));
    if (!(cosine > 0.0f) || patch.leaf == kNoLeaf) return 0.0f;
    const float probability = tree_.probability(patch.leaf, treeReceiver(to));
    return patch.inverseArea * probability * distance * distance / cosine;
}

float LightTable::environmentPdf(const Receiver& to, const glm::vec3& direction) const {
    if (!environment_.hasMap()) return 0.0f;
    const float choice = tree_.besideProbability(treeReceiver(to)) * environmentIrradiance() / infiniteIrradiance(to);
    return environment_.pdf(direction) * choice;
}

}  // namespace voxray::path_trace
