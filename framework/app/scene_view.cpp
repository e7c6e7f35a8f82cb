#include "app/scene_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <memory>
#include <numeric>

#include "app/view_search.h"
#include "experiment/checks/view.h"
#include "passes/path_trace/path_tracer.h"

namespace voxray {
namespace {

constexpr size_t kLookedAt = 32;  ///< Of all candidates, those that show most, with light.

bool shines(const SceneState& state) {
    const auto emits = [](const Material& m) { return m.emission != glm::vec3(0.0f); };
    return !state.lights.empty() || state.scene->environment.radiance != glm::vec3(0.0f) ||
           std::ranges::any_of(state.scene->materials, emits);
}

/// The best view in the scene's own light.
std::pair<CameraSettings, Sight> best(const SceneState& state, const EmbreeScene& tracer) {
    std::vector<CameraSettings> cameras = cameraCandidates(state, tracer);
    std::pair found(cameras.front(), look(state, tracer, cameras.front()));
    if (found.second.isGood()) return found;

    std::vector<std::pair<float, size_t>> order;
    for (size_t i = 0; i < cameras.size(); ++i) {
        Sight sight = lookAround(state, tracer, cameras[i]);
        sight.lit = 1;
        order.emplace_back(-sight.score(), i);
    }
    std::ranges::sort(order);
    if (order.size() > kLookedAt) order.resize(kLookedAt);
    for (const auto& [score, i] : order)
        if (const Sight sight = look(state, tracer, cameras[i]); sight.score() > found.second.score())
            found = {cameras[i], sight};
    return found;
}

/// A number with as many digits as tell `step` apart, four at least.
std::string number(float value, float step) {
    const float ratio = std::abs(value) / step;
    const int digits = ratio > 1 ? int(std::ceil(std::log10(ratio))) : 0;
    return fmt::format("{:.{}g}", value, std::clamp(digits, 4, 9));
}

std::string triple(const glm::vec3& v, float step) {
    return fmt::format("[{}, {}, {}]", number(v.x, step), number(v.y, step), number(v.z, step));
}

constexpr float kPlaces = 1e-3f;  ///< Of the distance to the target, by which what is printed may be off.

/// A lamp at the camera by which the mean radiance of what it sees is one that pictures show well, whatever
/// light surfaces send to each other.
Light lampFor(const SceneState& state, const EmbreeScene& tracer, const CameraSettings& camera,
              const Sight& sight) {
    Light lamp;
    lamp.type = LightType::Point;
    lamp.position = camera.position;
    const float distance = std::max(sight.distance, 1e-6f);
    lamp.intensity = glm::vec3(glm::pi<float>() * distance * distance);  // Irradiance of pi at that distance.
    SceneState lit = state;
    lit.lights = {lamp};
    const PathTraceOptions options{.width = 32, .height = 18, .spp = 16, .bounces = 8};
    const ImageF image = pathTrace(lit, tracer, cameraOf(camera), options).total;
    const double mean =
        std::accumulate(image.data.begin(), image.data.end(), 0.0) / double(image.data.size());
    if (mean > 0 && sight.filled > 0) lamp.intensity *= float(kWellSeen * double(sight.filled) / mean);
    return lamp;
}

}  // namespace

SuggestedView suggestView(const SceneState& state, const EmbreeScene& tracer) {
    constexpr float kLit = 0.1f;
    SuggestedView view;
    auto [camera, sight] = best(state, tracer);
    if (sight.lit < kLit && !shines(state)) {
        auto lit = std::make_shared<Scene>(*state.scene);
        lit->environment.radiance = glm::vec3(1.0f);
        SceneState inSky = state;
        inSky.scene = lit;
        std::tie(camera, sight) = best(inSky, tracer);
        view.light = "environment: 1";
    }
    view.camera = camera;
    if (sight.lit >= kLit) return view;

    // A lamp at the camera lights all that it sees
    const float step = kPlaces * glm::length(camera.target - camera.position);
    view.lamp = lampFor(state, tracer, camera, sight);
    view.light = fmt::format("lights: [{{point: {}, intensity: {:.3g}}}]", triple(camera.position, step),
                             view.lamp->intensity.x);
    return view;
}

bool seesLight(const SceneState& state, const EmbreeScene& tracer, const CameraSettings& camera) {
    const Sight sight = look(state, tracer, camera);
    return sight.filled > 0.01f && sight.lit > 0.02f && sight.fronts >= 0.5f;
}

CameraSettings settingsOf(const Camera& camera, const Geometry& geometry, const EmbreeScene& tracer) {
    const glm::vec3 center = 0.5f * (geometry.boundsMin + geometry.boundsMax);
    CameraSettings settings;
    settings.position = camera.position;
    float distance = std::max(0.1f * glm::length(geometry.boundsMax - geometry.boundsMin),
                              glm::dot(center - camera.position, camera.forward));
    const Hit hit =
        tracer.closestHit({camera.position, 0, camera.forward, std::numeric_limits<float>::infinity()});
    if (hit.triangle != Hit::kMiss && distance > 10 * hit.t && hit.t > 0) distance = hit.t;
    settings.target = camera.position + distance * camera.forward;
    settings.up = camera.up;
    settings.fovDegrees = glm::degrees(camera.verticalFovRadians);
    return settings;
}

std::string yamlOf(const CameraSettings& camera) {
    // Upright cameras need no 'up'
    const glm::vec3 way = camera.target - camera.position, right = glm::cross(way, camera.up);
    const bool isUpright = camera.up.y > 0 && std::abs(right.y) < 1e-3f * glm::length(right);
    const std::string up = isUpright ? "" : ", up: " + triple(camera.up, kPlaces);
    const float step = kPlaces * glm::length(way);
    return fmt::format("camera: {{position: {}, target: {}{}, fov_deg: {:.4g}}}",
                       triple(camera.position, step), triple(camera.target, step), up, camera.fovDegrees);
}

}  // namespace voxray
