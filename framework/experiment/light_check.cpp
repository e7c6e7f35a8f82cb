#include "experiment/light_check.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/vec2.hpp>
#include <limits>

#include "experiment/facing.h"
#include "experiment/light_blockers.h"

namespace voxray {
namespace {

constexpr uint32_t kRays = 4096;  ///< Of each kind, of a light.

/// What a light's rays met so far.
enum class Met { Nothing, Backs, Fronts };

struct Axes {
    glm::vec3 x, y;
};

Axes perpendicularTo(const glm::vec3& direction) {
    const glm::vec3 other = std::abs(direction.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    const glm::vec3 x = glm::normalize(glm::cross(direction, other));
    return {x, glm::cross(direction, x)};
}

/// A point of a sequence that fills the unit square evenly. Source: Roberts 2018, "The Unreasonable
/// Effectiveness of Quasirandom Sequences" (the plastic number's powers).
glm::vec2 evenPoint(uint32_t i) {
    const glm::dvec2 point = double(i + 1) * glm::dvec2(0.7548776662466927, 0.5698402909980532);
    return glm::vec2(point - glm::floor(point));
}

/// The i-th of kRays rays that a light at a point sends.
Ray sentRay(const Light& light, uint32_t i) {
    const glm::vec2 point = evenPoint(i);
    const Axes axes = perpendicularTo(light.direction);
    const float lowest = light.type == LightType::Spot ? std::cos(light.outerConeAngle) : -1.0f;
    const float cosine = glm::mix(lowest, 1.0f, point.x), azimuth = glm::two_pi<float>() * point.y;
    const float sine = std::sqrt(std::max(0.0f, 1 - cosine * cosine));
    const glm::vec3 direction =
        cosine * light.direction + sine * (std::cos(azimuth) * axes.x + std::sin(azimuth) * axes.y);
    return {light.position, 0, glm::normalize(direction), std::numeric_limits<float>::infinity()};
}

bool hasBack(const SceneState& state, uint32_t triangle) {
    return !state.scene->materials[state.geometry.triangleMaterials[triangle]].doubleSided;
}

bool isFinite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// A ray of the light to a triangle's center; inactive where it does not shine there.
Ray rayTo(const Light& light, const Geometry& g, uint32_t triangle) {
    const glm::uvec3 corners = g.triangles[triangle];
    const glm::vec3 center =
        (g.positions[corners.x] + g.positions[corners.y] + g.positions[corners.z]) / 3.0f;
    const glm::vec3 way = center - light.position;
    const float distance = glm::length(way);
    const bool isInCone = light.type != LightType::Spot ||
                          glm::dot(way, light.direction) > distance * std::cos(light.outerConeAngle);
    const float end = isInCone && distance > 0 ? std::numeric_limits<float>::infinity() : -1.0f;
    return {light.position, 0, distance > 0 ? way / distance : light.direction, end};
}

/// Which sides of surfaces parallel light comes to: looked for from points of them, since its rays begin
/// nowhere.
Met whatIsMetByParallel(const Light& light, const SceneState& state, const EmbreeScene& tracer, size_t step) {
    const Geometry& g = state.geometry;
    const size_t triangles = g.triangles.size();
    const uint32_t points = uint32_t(std::max<size_t>(1, kRays / std::max<size_t>(1, triangles)));
    Met met = Met::Nothing;
    for (size_t t = 0; t < triangles; t += step)
        for (uint32_t i = 0; i < points; ++i) {
            glm::vec2 at = evenPoint(i);
            if (at.x + at.y > 1) at = 1.0f - at;
            const glm::vec3 from = pointTowards(g, uint32_t(t), at.x, at.y, light.direction);
            const Ray back{from, 0, -light.direction, std::numeric_limits<float>::infinity()};
            if (!isFinite(from) || tracer.occluded(back)) continue;
            if (!hasBack(state, uint32_t(t)) || !showsBack(g, uint32_t(t), light.direction))
                return Met::Fronts;
            met = Met::Backs;
        }
    return met;
}

Met whatIsMet(const Light& light, const SceneState& state, const EmbreeScene& tracer) {
    const Geometry& g = state.geometry;
    const size_t triangles = g.triangles.size();
    const size_t step = std::max<size_t>(1, triangles / kRays);
    if (light.type == LightType::Directional) return whatIsMetByParallel(light, state, tracer, step);
    Met met = Met::Nothing;
    const auto look = [&](const Ray& ray) {
        if (ray.tMax < ray.tMin || met == Met::Fronts) return;
        const Hit hit = tracer.closestHit(ray);
        if (hit.triangle == Hit::kMiss) return;
        met = hasBack(state, hit.triangle) && showsBack(g, hit.triangle, ray.direction) ? Met::Backs
                                                                                        : Met::Fronts;
    };
    for (uint32_t i = 0; i < kRays; ++i) look(sentRay(light, i));
    // Few of a distant light's rays come near
    for (size_t t = 0; t < triangles; t += step) look(rayTo(light, g, uint32_t(t)));
    return met;
}

/// The way from a point to a light, inactive where it does not shine there.
Ray rayFrom(const SeenPoint& point, const Light& light) {
    constexpr float kShorter = 1 - 1e-4f;
    const Ray inactive{point.position, 0, light.direction, -1};
    glm::vec3 way = -light.direction;
    float distance = std::numeric_limits<float>::infinity();
    if (light.type != LightType::Directional) {
        distance = glm::length(light.position - point.position);
        if (!(distance > 0)) return inactive;
        way = (light.position - point.position) / distance;
    }
    const bool isInCone =
        light.type != LightType::Spot || glm::dot(-way, light.direction) > std::cos(light.outerConeAngle);
    if (!isInCone || glm::dot(way, point.normal) <= 0) return inactive;
    return {point.position, 0, way, kShorter * distance};
}

std::vector<Ray> raysFrom(std::span<const SeenPoint> seen, const Light& light) {
    std::vector<Ray> rays;
    for (const SeenPoint& point : seen) rays.push_back(rayFrom(point, light));
    return rays;
}

/// "; it stands 298 m away from a scene that reaches from [...] to [...]" of a lamp that is farther off than
/// the scene is large; else "".
std::string howFar(const Light& light, const Geometry& g) {
    if (light.type == LightType::Directional) return {};
    const float distance =
        glm::distance(light.position, glm::clamp(light.position, g.boundsMin, g.boundsMax));
    if (distance <= glm::distance(g.boundsMin, g.boundsMax)) return {};
    const auto triple = [](const glm::vec3& v) {
        return fmt::format("[{:.4g}, {:.4g}, {:.4g}]", v.x, v.y, v.z);
    };
    return fmt::format("; it stands {:.3g} m away from a scene that reaches from {} to {}", distance,
                       triple(g.boundsMin), triple(g.boundsMax));
}

bool isInSight(std::span<const Ray> ways, const EmbreeScene& tracer) {
    const auto inSight = std::ranges::count_if(
        ways, [&](const Ray& ray) { return ray.tMax > ray.tMin && !tracer.occluded(ray); });
    // Where surfaces meet, rays along one of them may slip through the edge, which is seen as a line of
    // points
    return inSight * inSight > ptrdiff_t(ways.size());
}

/// Warnings of suns that a scene brings and that its own surfaces shut out. Lamps may well be in other rooms.
std::vector<std::string> warningsOfSuns(const SceneSettings& scene, const SceneState& state,
                                        const EmbreeScene& tracer, std::span<const SeenPoint> seen,
                                        const std::function<bool(const Light&)>& isFound) {
    std::vector<std::string> warnings;
    for (const Light& light : std::span(state.lights).first(state.lights.size() - scene.lights.size())) {
        if (light.type != LightType::Directional || light.intensity == glm::vec3(0.0f)) continue;
        const std::vector<Ray> ways = raysFrom(seen, light);
        if (isInSight(ways, tracer) || isFound(light)) continue;
        warnings.push_back(
            UsageError(scene.where,
                       "scene: none of the light of its sun '{}' comes to what the camera sees{}", light.name,
                       blockerAdvice(ways, state, tracer))
                .what());
    }
    return warnings;
}

}  // namespace

std::vector<std::string> lightWarnings(const SceneSettings& scene, const SceneState& state,
                                       const EmbreeScene& tracer, std::span<const SeenPoint> seen,
                                       const std::function<bool(const Light&)>& isFound) {
    std::vector<std::string> warnings = warningsOfSuns(scene, state, tracer, seen, isFound);
    for (size_t i = 0; i < scene.lights.size(); ++i) {
        const ConfigLight& entry = scene.lights[i];
        const auto warn = [&](const std::string& what) {
            warnings.push_back(UsageError(entry.where, "scene.lights[{}]: {}{}", i, what,
                                          howFar(entry.light, state.geometry))
                                   .what());
        };
        if (entry.light.intensity == glm::vec3(0.0f)) {
            warn("it is black and lights nothing");
            continue;
        }
        if (entry.move != glm::vec3(0.0f)) continue;
        const Met met = whatIsMet(entry.light, state, tracer);
        const std::vector<Ray> ways = raysFrom(seen, entry.light);
        if (met == Met::Nothing)
            warn(
                "it lights nothing: no surface lies where it shines; is its direction the way that the light "
                "travels, and are its numbers metres?");
        else if (met == Met::Backs)
            warn(
                "it lights the backs of surfaces alone, from outside of a room or within a solid; is its "
                "direction the way that the light travels, and are its numbers metres?" +
                blockerAdvice(ways, state, tracer));
        else if (!isInSight(ways, tracer) && !isFound(entry.light))
            warn((entry.light.type == LightType::Directional
                      ? "none of its light comes to what the camera sees: is its direction the way that the "
                        "light travels?"
                      : "none of its light comes to what the camera sees: does it stand inside of an object, "
                        "or behind a wall?") +
                 blockerAdvice(ways, state, tracer));
    }
    return warnings;
}

}  // namespace voxray
