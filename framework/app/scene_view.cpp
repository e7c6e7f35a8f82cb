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
#include "experiment/scene_setup.h"
#include "passes/path_trace/path_tracer.h"

namespace voxray {
namespace {

constexpr size_t kMaxPathTraced = 32;  ///< Limit of candidates that are path traced.

bool hasLight(const SceneState& state) {
    const auto emits = [](const Material& m) { return m.emission != glm::vec3(0.0f); };
    return !state.lights.empty() || state.scene->environment.radiance != glm::vec3(0.0f) ||
           std::ranges::any_of(state.scene->materials, emits);
}

/// The best view with the lights of the scene.
std::pair<CameraSettings, ViewStats> best(const SceneState& state, const EmbreeScene& tracer) {
    std::vector<CameraSettings> cameras = cameraCandidates(state, tracer);
    std::pair found(cameras.front(), measureView(state, tracer, cameras.front()));
    const float least = leastDistance(state);
    if (found.second.isGood(least)) return found;

    std::vector<std::pair<float, size_t>> order;
    for (size_t i = 0; i < cameras.size(); ++i) {
        ViewStats stats = measureGeometry(state, tracer, cameras[i]);
        stats.lit = 1;
        order.emplace_back(-stats.score(least), i);
    }
    std::ranges::sort(order);
    if (order.size() > kMaxPathTraced) order.resize(kMaxPathTraced);
    for (const auto& [score, i] : order)
        if (const ViewStats stats = measureView(state, tracer, cameras[i]);
            stats.score(least) > found.second.score(least))
            found = {cameras[i], stats};
    return found;
}

/// A number with a precision of `step`, at least four digits.
std::string number(float value, float step) {
    const float ratio = std::abs(value) / step;
    const int digits = ratio > 1 ? int(std::ceil(std::log10(ratio))) : 0;
    return fmt::format("{:.{}g}", value, std::clamp(digits, 4, 9));
}

std::string triple(const glm::vec3& v, float step) {
    return fmt::format("[{}, {}, {}]", number(v.x, step), number(v.y, step), number(v.z, step));
}

constexpr float kPrecision = 1e-3f;  ///< Of coordinates, relative to the distance of the target.

/// A lamp at the camera that results in a mean radiance of kPreviewRadiance, including indirect light.
Light lampFor(const SceneState& state, const EmbreeScene& tracer, const CameraSettings& camera,
              const ViewStats& stats) {
    Light lamp;
    lamp.type = LightType::Point;
    lamp.position = camera.position;
    const float distance = std::max(stats.distance, 1e-6f);
    lamp.intensity = glm::vec3(glm::pi<float>() * distance * distance);  // Irradiance of pi at that distance.
    SceneState lit = state;
    lit.lights = {lamp};
    const PathTraceOptions options{.width = 32, .height = 18, .spp = 16, .bounces = 8};
    const ImageF image = pathTrace(lit, tracer, cameraOf(camera), options).total;
    const double mean = std::accumulate(image.data.begin(), image.data.end(), 0.0) / double(image.data.size());
    if (mean > 0 && stats.filled > 0) lamp.intensity *= float(kPreviewRadiance * double(stats.filled) / mean);
    return lamp;
}

}  // namespace

SceneState withEnvironment(SceneState state) {
    auto lit = std::make_shared<Scene>(*state.scene);
    lit->environment.radiance = glm::vec3(1.0f);
    state.scene = lit;
    return state;
}

SuggestedView suggestView(const SceneState& state, const EmbreeScene& tracer) {
    constexpr float kLit = 0.1f;
    SuggestedView view;
    auto [camera, stats] = best(state, tracer);
    if (stats.lit < kLit && !hasLight(state)) {
        std::tie(camera, stats) = best(withEnvironment(state), tracer);
        view.light = "environment: 1";
    }
    view.camera = camera;
    if (stats.lit >= kLit) return view;

    // A lamp at the camera lights all visible surfaces
    const float step = kPrecision * glm::length(camera.target - camera.position);
    view.lamp = lampFor(state, tracer, camera, stats);
    view.light = fmt::format("lights: [{{point: {}, intensity: {:.3g}}}]", triple(camera.position, step),
                             view.lamp->intensity.x);
    return view;
}

FirstView firstView(const SceneState& state, const EmbreeScene& tracer, const std::optional<Camera>& own,
                    bool alwaysSearches) {
    FirstView view;
    if (own) {
        view.own = view.camera = settingsOf(*own, state.geometry, tracer);
        view.seesOwnLight = seesLight(state, tracer, view.camera);
    }
    if (view.seesOwnLight && !alwaysSearches) return view;
    view.searched = suggestView(state, tracer);
    if (view.seesOwnLight) return view;
    view.light = view.searched->light;
    const bool seesAddedLight =
        own && !hasLight(state) && !view.light.empty() && seesLight(withEnvironment(state), tracer, view.camera);
    if (!seesAddedLight) view.camera = view.searched->camera;
    return view;
}

bool seesLight(const SceneState& state, const EmbreeScene& tracer, const CameraSettings& camera) {
    const ViewStats stats = measureView(state, tracer, camera);
    return stats.filled > 0.01f && stats.lit > 0.02f && stats.fronts >= 0.5f;
}

CameraSettings settingsOf(const Camera& camera, const Geometry& geometry, const EmbreeScene& tracer) {
    const glm::vec3 center = 0.5f * (geometry.boundsMin + geometry.boundsMax);
    CameraSettings settings;
    settings.position = camera.position;
    float distance = std::max(0.1f * glm::length(geometry.boundsMax - geometry.boundsMin),
                              glm::dot(center - camera.position, camera.forward));
    const Hit hit = tracer.closestHit({camera.position, 0, camera.forward, std::numeric_limits<float>::infinity()});
    if (hit.triangle != Hit::kMiss && distance > 10 * hit.t && hit.t > 0) distance = hit.t;
    settings.target = camera.position + distance * camera.forward;
    settings.up = camera.up;
    settings.fovDegrees = glm::degrees(camera.verticalFovRadians);
    return settings;
}

std::string yamlOf(const CameraSettings& camera) {
    // Upright cameras need no 'up'
    const glm::vec3 forward = camera.target - camera.position, right = glm::cross(forward, camera.up);
    const bool isUpright = camera.up.y > 0 && std::abs(right.y) < 1e-3f * glm::length(right);
    const std::string up = isUpright ? "" : ", up: " + triple(camera.up, kPrecision);
    const float step = kPrecision * glm::length(forward);
    return fmt::format("camera: {{position: {}, target: {}{}, fov_deg: {:.4g}}}", triple(camera.position, step),
                       triple(camera.target, step), up, camera.fovDegrees);
}

}  // namespace voxray
