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
constexpr double kLeastStops = 2;      ///< Less is no matter of visibility.
constexpr double kMaxStops = 30;       ///< That image.exposure_stops allows.

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

/// Scales a light so that what the camera sees of surfaces has a mean radiance of kPreviewRadiance, including indirect
/// light. @param state without lights
void expose(SuggestedLight& light, const SceneState& state, const EmbreeScene& tracer, const CameraSettings& camera,
            const ViewStats& stats) {
    const PathTraceOptions options{.width = 32, .height = 18, .spp = 16, .bounces = 8};
    const ImageF image = pathTrace(withLight(state, light), tracer, cameraOf(camera), options).total;
    const double mean = std::accumulate(image.data.begin(), image.data.end(), 0.0) / double(image.data.size());
    const double filled = double(stats.filled), ofSurfaces = mean - (1 - filled) * double(light.sky);
    if (ofSurfaces <= 0 || filled <= 0) return;
    const float scale = float(kPreviewRadiance * filled / ofSurfaces);
    light.light->intensity *= scale;
    light.sky *= scale;
}

/// A lamp at the camera.
SuggestedLight lampFor(SceneState state, const EmbreeScene& tracer, const CameraSettings& camera,
                       const ViewStats& stats) {
    SuggestedLight light;
    Light& lamp = light.light.emplace();
    lamp.type = LightType::Point;
    lamp.position = camera.position;
    const float distance = std::max(stats.distance, 1e-6f);
    lamp.intensity = glm::vec3(glm::pi<float>() * distance * distance);  // Irradiance of pi at that distance.
    state.lights.clear();
    expose(light, state, tracer, camera, stats);
    const float step = kPrecision * glm::length(camera.target - camera.position);
    light.yaml =
        fmt::format("lights: [{{point: {}, intensity: {:.3g}}}]", triple(camera.position, step), lamp.intensity.x);
    return light;
}

constexpr float kSkyOfSun = 0.1f / glm::pi<float>();  ///< Radiance of the sky by irradiance of the sun, 1/sr.

/// A sun from above and left of the camera, with a sky that lights what the sun does not reach.
SuggestedLight daylightFor(const SceneState& state, const EmbreeScene& tracer, const CameraSettings& camera,
                           const ViewStats& stats) {
    const glm::vec3 forward = glm::normalize(camera.target - camera.position);
    const glm::vec3 right = glm::normalize(glm::cross(forward, camera.up)), up = glm::cross(right, forward);
    SuggestedLight light;
    Light& sun = light.light.emplace();
    sun.type = LightType::Directional;
    sun.direction = glm::normalize(forward + 0.5f * right - 0.8f * up);
    sun.intensity = glm::vec3(glm::pi<float>());  // A white surface that faces it has a radiance of 1
    light.sky = kSkyOfSun * sun.intensity.x;
    expose(light, state, tracer, camera, stats);
    light.yaml = fmt::format("lights: [{{directional: {}, irradiance: {:.3g}}}]\n  environment: {:.2g}",
                             triple(sun.direction, kPrecision), sun.intensity.x, light.sky);
    return light;
}

/// Tells what a sky lights.
SuggestedLight evenSky() {
    return {{}, {}, 1.0f};
}

/// The stops by which half of what a camera sees is brighter than kPreviewRadiance in previews, whole ones, at least
/// kLeastStops or none: the median is that of the room where a small lamp is in view, too.
int meteredStops(const SceneState& state, const EmbreeScene& tracer, const CameraSettings& camera) {
    const PathTraceOptions options{.width = 32, .height = 18, .spp = 64, .bounces = 8};
    const ImageF image = pathTrace(state, tracer, cameraOf(camera), options).total;
    std::vector<float> lit;
    for (size_t i = 0; i + 2 < image.data.size(); i += 3)
        if (const float mean = (image.data[i] + image.data[i + 1] + image.data[i + 2]) / 3; mean > 0)
            lit.push_back(mean);
    if (lit.empty()) return 0;
    const auto median = lit.begin() + std::ptrdiff_t(lit.size() / 2);
    std::ranges::nth_element(lit, median);
    const double stops = std::round(std::log2(kPreviewRadiance / double(*median)));
    return std::abs(stops) < kLeastStops ? 0 : int(std::clamp(stops, -kMaxStops, kMaxStops));
}

FirstView viewOf(const SceneState& state, const EmbreeScene& tracer, const std::optional<Camera>& own,
                 bool alwaysSearches) {
    FirstView view;
    if (own) {
        view.own = view.camera = settingsOf(*own, state.geometry, tracer);
        view.seesOwnLight = seesLight(state, tracer, view.camera);
    }
    if (view.seesOwnLight && !alwaysSearches) return view;
    view.searched = suggestView(state, tracer);
    if (view.seesOwnLight) return view;
    const bool seesSky = own && !hasLight(state) && seesLight(withLight(state, evenSky()), tracer, view.camera);
    if (!seesSky) view.camera = view.searched->camera;
    view.light = seesSky ? daylightFor(state, tracer, view.camera, measureGeometry(state, tracer, view.camera))
                         : view.searched->light;
    return view;
}

}  // namespace

SceneState withLight(SceneState state, const SuggestedLight& light) {
    if (light.light) state.lights.push_back(*light.light);
    if (light.sky > 0) {
        auto lit = std::make_shared<Scene>(*state.scene);
        lit->environment.radiance = glm::vec3(light.sky);
        state.scene = lit;
    }
    return state;
}

SuggestedView suggestView(const SceneState& state, const EmbreeScene& tracer) {
    constexpr float kLit = 0.1f;
    SuggestedView view;
    auto [camera, stats] = best(state, tracer);
    const bool needsSky = stats.lit < kLit && !hasLight(state);
    if (needsSky) std::tie(camera, stats) = best(withLight(state, evenSky()), tracer);
    view.camera = camera;
    if (stats.lit < kLit)
        view.light = lampFor(state, tracer, camera, stats);  // It lights all visible surfaces
    else if (needsSky)
        view.light = daylightFor(state, tracer, camera, stats);
    return view;
}

FirstView firstView(const SceneState& state, const EmbreeScene& tracer, const std::optional<Camera>& own,
                    bool alwaysSearches) {
    FirstView view = viewOf(state, tracer, own, alwaysSearches);
    if (view.light.yaml.empty()) view.exposureStops = meteredStops(state, tracer, view.camera);
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
