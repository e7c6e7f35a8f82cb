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

constexpr uint32_t kRays = 4096;  ///< For each light: in all its directions, and to triangles.

/// The sides of surfaces that a light's rays hit.
enum class LitSides { Nothing, Backs, Fronts };

struct Axes {
    glm::vec3 x, y;
};

Axes perpendicularTo(const glm::vec3& direction) {
    const glm::vec3 up = std::abs(direction.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    const glm::vec3 x = glm::normalize(glm::cross(direction, up));
    return {x, glm::cross(direction, x)};
}

/// A point of the R2 low-discrepancy sequence in the unit square. Source: Roberts 2018, "The Unreasonable
/// Effectiveness of Quasirandom Sequences" (the plastic number's powers).
glm::vec2 evenPoint(uint32_t i) {
    const glm::dvec2 point = double(i + 1) * glm::dvec2(0.7548776662466927, 0.5698402909980532);
    return glm::vec2(point - glm::floor(point));
}

/// The i-th of kRays rays from a point or spot light.
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

bool isFinite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// A ray from the light to a triangle's center; inactive outside of a spot's cone.
Ray rayTo(const Light& light, const Geometry& g, uint32_t triangle) {
    const glm::uvec3 corners = g.triangles[triangle];
    const glm::vec3 center = (g.positions[corners.x] + g.positions[corners.y] + g.positions[corners.z]) / 3.0f;
    const glm::vec3 toCenter = center - light.position;
    const float distance = glm::length(toCenter);
    const bool isInCone = light.type != LightType::Spot ||
                          glm::dot(toCenter, light.direction) > distance * std::cos(light.outerConeAngle);
    const float end = isInCone && distance > 0 ? std::numeric_limits<float>::infinity() : -1.0f;
    return {light.position, 0, distance > 0 ? toCenter / distance : light.direction, end};
}

/// The sides of surfaces that a directional light reaches. Rays are traced from the surfaces to the light,
/// which has no position.
LitSides directionalLitSides(const Light& light, const SceneState& state, const EmbreeScene& tracer, size_t step) {
    const Geometry& g = state.geometry;
    const size_t triangles = g.triangles.size();
    const uint32_t points = uint32_t(std::max<size_t>(1, kRays / std::max<size_t>(1, triangles)));
    LitSides sides = LitSides::Nothing;
    for (size_t t = 0; t < triangles; t += step)
        for (uint32_t i = 0; i < points; ++i) {
            glm::vec2 uv = evenPoint(i);
            if (uv.x + uv.y > 1) uv = 1.0f - uv;
            const glm::vec3 origin = pointTowards(g, uint32_t(t), uv.x, uv.y, light.direction);
            const Ray toLight{origin, 0, -light.direction, std::numeric_limits<float>::infinity()};
            if (!isFinite(origin) || tracer.occluded(toLight)) continue;
            if (!isSingleSidedBack(state, uint32_t(t), light.direction)) return LitSides::Fronts;
            sides = LitSides::Backs;
        }
    return sides;
}

LitSides litSides(const Light& light, const SceneState& state, const EmbreeScene& tracer) {
    const Geometry& g = state.geometry;
    const size_t triangles = g.triangles.size();
    const size_t step = std::max<size_t>(1, triangles / kRays);
    if (light.type == LightType::Directional) return directionalLitSides(light, state, tracer, step);
    LitSides sides = LitSides::Nothing;
    const auto trace = [&](const Ray& ray) {
        if (ray.tMax < ray.tMin || sides == LitSides::Fronts) return;
        const Hit hit = tracer.closestHit(ray);
        if (hit.triangle == Hit::kMiss) return;
        sides = isSingleSidedBack(state, hit.triangle, ray.direction) ? LitSides::Backs : LitSides::Fronts;
    };
    for (uint32_t i = 0; i < kRays; ++i) trace(sentRay(light, i));
    // Few of these rays hit the scene if the light is far away
    for (size_t t = 0; t < triangles; t += step) trace(rayTo(light, g, uint32_t(t)));
    return sides;
}

/// A shadow ray from a point to a light; inactive outside of a spot's cone.
Ray rayFrom(const VisiblePoint& point, const Light& light) {
    constexpr float kShorter = 1 - 1e-4f;
    const Ray inactive{point.position, 0, light.direction, -1};
    glm::vec3 direction = -light.direction;
    float distance = std::numeric_limits<float>::infinity();
    if (light.type != LightType::Directional) {
        distance = glm::length(light.position - point.position);
        if (!(distance > 0)) return inactive;
        direction = (light.position - point.position) / distance;
    }
    const bool isInCone =
        light.type != LightType::Spot || glm::dot(-direction, light.direction) > std::cos(light.outerConeAngle);
    if (!isInCone || glm::dot(direction, point.normal) <= 0) return inactive;
    return {point.position, 0, direction, kShorter * distance};
}

std::vector<Ray> raysFrom(std::span<const VisiblePoint> points, const Light& light) {
    std::vector<Ray> rays;
    for (const VisiblePoint& point : points) rays.push_back(rayFrom(point, light));
    return rays;
}

/// A hint for a light that is farther from the scene than the scene is large, such as "it stands 298 m away
/// from a scene that reaches from [...] to [...]"; else "".
std::string howFar(const Light& light, const Geometry& g) {
    if (light.type == LightType::Directional) return {};
    const float distance = glm::distance(light.position, glm::clamp(light.position, g.boundsMin, g.boundsMax));
    if (distance <= glm::distance(g.boundsMin, g.boundsMax)) return {};
    return fmt::format("it stands {:.3g} m away from a scene that reaches from {} to {}", distance,
                       bracketed(g.boundsMin), bracketed(g.boundsMax));
}

/// Whether a significant number of rays is unoccluded.
bool isUnoccluded(std::span<const Ray> rays, const EmbreeScene& tracer) {
    const auto unoccluded =
        std::ranges::count_if(rays, [&](const Ray& ray) { return ray.tMax > ray.tMin && !tracer.occluded(ray); });
    // A few rays pass between adjacent surfaces because of rounding, about sqrt(n) of n along a line
    return unoccluded * unoccluded > ptrdiff_t(rays.size());
}

/// A problem of a light, and advice about its occluder.
struct Finding {
    const char* text = "";  ///< "": no problem.
    std::string advice;
};

Finding findingOf(const ConfigLight& entry, const View& view) {
    if (entry.light.intensity == glm::vec3(0.0f)) return {"it is black and lights nothing", ""};
    if (entry.move != glm::vec3(0.0f)) return {};  // The view may be lit in later frames.
    const std::vector<Ray> rays = raysFrom(view.points, entry.light);
    switch (litSides(entry.light, view.state(), view.tracer)) {
        case LitSides::Nothing:
            return {
                "it lights nothing: no surface lies where it shines; "
                "is its direction the way that the light travels, and are its numbers metres?",
                ""};
        case LitSides::Backs:
            return {
                "it lights the backs of surfaces alone, from outside of a room or within a solid; "
                "is its direction the way that the light travels, and are its numbers metres?",
                occluderAdvice(rays, view.state(), view.tracer)};
        case LitSides::Fronts:
            break;
    }
    if (isUnoccluded(rays, view.tracer) || view.reachesView(entry.light)) return {};
    return {entry.light.type == LightType::Directional
                ? "none of its light comes to what the camera sees: is its direction the way that the light travels?"
                : "none of its light comes to what the camera sees: "
                  "does it stand inside of an object, or behind a wall?",
            occluderAdvice(rays, view.state(), view.tracer)};
}

}  // namespace

/// Reports suns of the scene file that are occluded everywhere in the view. Other lights of the file are not
/// reported: they may light other rooms.
void occludedSuns(const View& view, Diagnostics& found) {
    const std::vector<Light>& lights = view.state().lights;
    for (const Light& light : std::span(lights).first(lights.size() - view.scene().lights.size())) {
        if (light.type != LightType::Directional || light.intensity == glm::vec3(0.0f)) continue;
        const std::vector<Ray> rays = raysFrom(view.points, light);
        if (isUnoccluded(rays, view.tracer) || view.reachesView(light)) continue;
        found.push_back(
            {view.scene().where,
             fmt::format("scene: none of the light of its sun '{}' comes to what the camera sees", light.name),
             occluderAdvice(rays, view.state(), view.tracer)});
    }
}

/// Reports lights of the config that hit no surface, hit only backs of surfaces, or light nothing that the
/// camera sees. Rays are traced in all directions of a light, and to triangles all over the scene.
void ineffectiveLights(const View& view, Diagnostics& found) {
    const std::vector<ConfigLight>& lights = view.scene().lights;
    for (size_t i = 0; i < lights.size(); ++i) {
        const Finding finding = findingOf(lights[i], view);
        if (!*finding.text) continue;
        std::string advice = finding.advice;
        if (const std::string far = howFar(lights[i].light, view.state().geometry); !far.empty())
            advice += (advice.empty() ? "" : "; ") + far;
        found.push_back({lights[i].where, fmt::format("scene.lights[{}]: {}", i, finding.text), std::move(advice)});
    }
}

/// Reports spot lights whose cone angle in degrees is below pi / 2: it was probably given in radians.
void spotAngleInRadians(const View& view, Diagnostics& found) {
    const std::vector<ConfigLight>& lights = view.scene().lights;
    for (size_t i = 0; i < lights.size(); ++i) {
        const float angle = glm::degrees(lights[i].light.outerConeAngle);
        if (lights[i].light.type == LightType::Spot && angle <= glm::half_pi<float>())
            found.push_back({lights[i].where,
                             fmt::format("scene.lights[{}].outer_deg: {:.4g} degrees are a thin beam's", i, angle),
                             fmt::format("{:.4g} in radians is {:.4g} degrees", angle, glm::degrees(angle))});
    }
}

}  // namespace voxray
