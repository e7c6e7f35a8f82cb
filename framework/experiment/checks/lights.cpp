#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <limits>

#include "experiment/checks/blockers.h"
#include "experiment/checks/checks.h"
#include "experiment/checks/facing.h"

namespace voxray {
namespace {

constexpr uint32_t kRays = 4096;  ///< A light, sent out and towards triangles.

/// What a light's rays have hit so far.
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

/// Whether a directional light reaches fronts or backs of surfaces: rays are traced from the surfaces to the
/// light, which has no position.
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

/// A shadow ray from a point to a light; inactive outside of a spot's cone.
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

/// A hint for a light that is farther from the scene than the scene is large, such as "it stands 298 m away
/// from a scene that reaches from [...] to [...]"; else "".
std::string howFar(const Light& light, const Geometry& g) {
    if (light.type == LightType::Directional) return {};
    const float distance =
        glm::distance(light.position, glm::clamp(light.position, g.boundsMin, g.boundsMax));
    if (distance <= glm::distance(g.boundsMin, g.boundsMax)) return {};
    return fmt::format("it stands {:.3g} m away from a scene that reaches from {} to {}", distance,
                       bracketed(g.boundsMin), bracketed(g.boundsMax));
}

bool isInSight(std::span<const Ray> ways, const EmbreeScene& tracer) {
    const auto inSight = std::ranges::count_if(
        ways, [&](const Ray& ray) { return ray.tMax > ray.tMin && !tracer.occluded(ray); });
    // Rays may slip through edges where surfaces meet. Such pixels form a line, about sqrt(n) of n, so only
    // more than that count as lit
    return inSight * inSight > ptrdiff_t(ways.size());
}

/// A message about a light, and what blocks it.
struct Finding {
    const char* text = "";  ///< "": nothing.
    std::string blocker;
};

Finding findingOf(const ConfigLight& entry, const View& view) {
    if (entry.light.intensity == glm::vec3(0.0f)) return {"it is black and lights nothing", ""};
    if (entry.move != glm::vec3(0.0f)) return {};  // It moves: later frames may be lit.
    const std::vector<Ray> ways = raysFrom(view.points, entry.light);
    switch (whatIsMet(entry.light, view.state(), view.tracer)) {
        case Met::Nothing:
            return {
                "it lights nothing: no surface lies where it shines; "
                "is its direction the way that the light travels, and are its numbers metres?",
                ""};
        case Met::Backs:
            return {
                "it lights the backs of surfaces alone, from outside of a room or within a solid; "
                "is its direction the way that the light travels, and are its numbers metres?",
                blockerAdvice(ways, view.state(), view.tracer)};
        case Met::Fronts:
            break;
    }
    if (isInSight(ways, view.tracer) || view.isFound(entry.light)) return {};
    return {entry.light.type == LightType::Directional
                ? "none of its light comes to what the camera sees: "
                  "is its direction the way that the light travels?"
                : "none of its light comes to what the camera sees: "
                  "does it stand inside of an object, or behind a wall?",
            blockerAdvice(ways, view.state(), view.tracer)};
}

}  // namespace

/// Reports suns of the scene file whose light is blocked everywhere that the camera sees. Other lights of the
/// file are not reported: they may light other rooms.
void sunsThatAreShutOut(const View& view, Diagnostics& found) {
    const std::vector<Light>& lights = view.state().lights;
    for (const Light& light : std::span(lights).first(lights.size() - view.scene().lights.size())) {
        if (light.type != LightType::Directional || light.intensity == glm::vec3(0.0f)) continue;
        const std::vector<Ray> ways = raysFrom(view.points, light);
        if (isInSight(ways, view.tracer) || view.isFound(light)) continue;
        found.push_back({view.scene().where,
                         fmt::format("scene: none of the light of its sun '{}' comes to what the camera sees",
                                     light.name),
                         blockerAdvice(ways, view.state(), view.tracer)});
    }
}

/// Reports lights of the config that hit no surface, hit only backs of surfaces, or light nothing that the
/// camera sees. Rays are traced in all directions of a light, and to triangles all over the scene.
void lightsThatLightNothing(const View& view, Diagnostics& found) {
    const std::vector<ConfigLight>& lights = view.scene().lights;
    for (size_t i = 0; i < lights.size(); ++i) {
        const Finding finding = findingOf(lights[i], view);
        if (!*finding.text) continue;
        std::string advice = finding.blocker;
        if (const std::string far = howFar(lights[i].light, view.state().geometry); !far.empty())
            advice += (advice.empty() ? "" : "; ") + far;
        found.push_back(
            {lights[i].where, fmt::format("scene.lights[{}]: {}", i, finding.text), std::move(advice)});
    }
}

/// Reports spot lights whose cone angle in degrees is below pi / 2: it was probably given in radians.
void spotAngleInRadians(const View& view, Diagnostics& found) {
    const std::vector<ConfigLight>& lights = view.scene().lights;
    for (size_t i = 0; i < lights.size(); ++i) {
        const float angle = glm::degrees(lights[i].light.outerConeAngle);
        if (lights[i].light.type == LightType::Spot && angle <= glm::half_pi<float>())
            found.push_back(
                {lights[i].where,
                 fmt::format("scene.lights[{}].outer_deg: {:.4g} degrees are a thin beam's", i, angle),
                 fmt::format("{:.4g} in radians is {:.4g} degrees", angle, glm::degrees(angle))});
    }
}

}  // namespace voxray
