#include "app/view_search.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

#include "experiment/checks/facing.h"
#include "experiment/scene_setup.h"
#include "passes/path_trace/path_tracer.h"
#include "scene/camera_rays.h"
#include "scene/outliers.h"
#include "scene/surface_offset.h"

namespace voxray {
namespace {

constexpr uint32_t kWidth = 32, kHeight = 18;  ///< Resolution of views.
constexpr int kRays = 200;                     ///< In all directions.
constexpr float kEnclosed = 0.7f;              ///< Fraction of them that hits front sides in an enclosed point.
constexpr float kRoomy = 0.1f;       ///< Their median distance there, relative to the box's diagonal; less is a gap.
constexpr size_t kMaxInstances = 6;  ///< Number of instances with cameras of their own.
constexpr float kLeastDistance = 0.02f;  ///< Relative to the scene's diagonal.

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// A point of a Fibonacci lattice, which is uniform on the sphere.
glm::vec3 directionOf(int ray) {
    const float z = 1 - (2 * float(ray) + 1) / kRays, angle = float(ray) * 2.39996323f;
    const float r = std::sqrt(1 - z * z);
    return {r * std::cos(angle), z, r * std::sin(angle)};
}

/// Whether the center of a box is in a room.
bool isEnclosed(const Box& box, const SceneState& state, const EmbreeScene& tracer) {
    const glm::vec3 center = 0.5f * (box.min + box.max);
    std::vector<float> distances;  // Of front sides
    for (int i = 0; i < kRays; ++i) {
        const glm::vec3 direction = directionOf(i);
        const Hit hit = tracer.closestHit({center, 0, direction, kInfinity});
        if (hit.triangle != Hit::kMiss && !isSingleSidedBack(state, hit.triangle, direction))
            distances.push_back(hit.t);
    }
    if (float(distances.size()) < kEnclosed * kRays) return false;
    std::ranges::nth_element(distances, distances.begin() + distances.size() / 2);
    return distances[distances.size() / 2] >= kRoomy * glm::length(box.max - box.min);
}

/// Bounding boxes of the scene, of the scene without outliers, and of its largest instances.
std::vector<Box> boxesOf(const Geometry& g) {
    std::vector<Box> boxes;
    for (const InstanceRange& range : g.instances) {
        if (range.vertexCount == 0) continue;
        Box box{g.positions[range.firstVertex], g.positions[range.firstVertex]};
        for (uint32_t i = 0; i < range.vertexCount; ++i) {
            const glm::vec3& p = g.positions[range.firstVertex + i];
            box = {glm::min(box.min, p), glm::max(box.max, p)};
        }
        boxes.push_back(box);
    }
    std::ranges::stable_sort(boxes, std::greater(), [](const Box& b) { return glm::length(b.max - b.min); });
    if (boxes.size() > kMaxInstances) boxes.resize(kMaxInstances);
    boxes.insert(boxes.begin(), {{g.boundsMin, g.boundsMax}, boundsWithoutOutliers(g)});
    return boxes;
}

CameraSettings lookingFrom(const glm::vec3& position, const glm::vec3& target) {
    CameraSettings camera;
    camera.position = position;
    camera.target = target;
    return camera;
}

/// A camera outside of a box that sees all of it.
CameraSettings outside(const Box& box, const glm::vec3& direction) {
    CameraSettings camera;
    const glm::vec3 center = 0.5f * (box.min + box.max);
    const float radius = std::max(0.5f * glm::length(box.max - box.min), 1e-3f);
    const float distance = radius / std::sin(glm::radians(camera.fovDegrees / 2));
    return lookingFrom(center + distance * glm::normalize(direction), center);
}

/// Adds cameras inside of a box, at its center and along the axes.
void addInside(const Box& box, std::vector<CameraSettings>& cameras) {
    const glm::vec3 center = 0.5f * (box.min + box.max), half = 0.5f * (box.max - box.min);
    const float reach = std::max({half.x, half.y, half.z, 1e-3f});
    for (const float y : {0.0f, 0.6f, -0.6f})
        for (const float z : {0.0f, 0.8f, -0.8f, 0.4f, -0.4f})
            for (const float x : {0.0f, 0.8f, -0.8f, 0.4f, -0.4f}) {
                const glm::vec3 position = center + half * glm::vec3(x, y, z);
                cameras.push_back(lookingFrom(position, {center.x, position.y, center.z}));
                for (int i = 0; i < 8; ++i) {
                    const float angle = float(i) * glm::quarter_pi<float>();
                    const glm::vec3 along(std::cos(angle), -0.2f, std::sin(angle));
                    cameras.push_back(lookingFrom(position, position + reach * along));
                }
            }
}

}  // namespace

float ViewStats::score(float leastDistance) const {
    const float depth = std::min(1.0f, distance / leastDistance);
    return std::sqrt(std::min(1.0f, 2 * filled)) * fronts * (1 - near) * depth * (0.01f + lit);
}

float leastDistance(const SceneState& state) {
    const Box box = boundsWithoutOutliers(state.geometry);
    return std::max(kLeastDistance * glm::length(box.max - box.min), 1e-6f);
}

ViewStats measureGeometry(const SceneState& state, const EmbreeScene& tracer, const CameraSettings& settings) {
    const CameraRays rays = cameraRays(cameraOf(settings), kWidth, kHeight);
    std::vector<float> distances;
    ViewStats stats;
    for (uint32_t y = 0; y < kHeight; ++y)
        for (uint32_t x = 0; x < kWidth; ++x) {
            const glm::vec3 direction =
                rays.direction((float(x) + 0.5f) / float(kWidth), (float(y) + 0.5f) / float(kHeight));
            const Hit hit = tracer.closestHit({rays.origin, 0, direction, kInfinity});
            if (hit.triangle == Hit::kMiss) continue;
            distances.push_back(hit.t);
            stats.fronts += isSingleSidedBack(state, hit.triangle, direction) ? 0.0f : 1.0f;
        }
    if (distances.empty()) return stats;
    std::ranges::sort(distances);
    const float far = distances[distances.size() * 3 / 4], count = float(distances.size());
    stats.filled = count / float(kWidth * kHeight);
    stats.fronts /= count;
    stats.near = float(std::ranges::lower_bound(distances, far / 20) - distances.begin()) / count;
    stats.distance = distances[distances.size() / 2];
    // The view of a camera on a surface depends on rounding
    if (stats.distance < 10 * pointOffset(settings.position)) stats.filled = 0;
    return stats;
}

ViewStats measureView(const SceneState& state, const EmbreeScene& tracer, const CameraSettings& camera) {
    ViewStats stats = measureGeometry(state, tracer, camera);
    if (stats.filled == 0) return stats;
    const PathTraceOptions options{.width = kWidth, .height = kHeight, .spp = 4, .bounces = 4};
    const ImageF image = pathTrace(state, tracer, cameraOf(camera), options).total;
    size_t lit = 0;
    for (size_t i = 0; i + 2 < image.data.size(); i += 3)
        lit += image.data[i] > 0 || image.data[i + 1] > 0 || image.data[i + 2] > 0;
    // Pixels without surfaces show the sky
    const bool hasSky = state.scene->environment.radiance != glm::vec3(0.0f);
    const float pixels = float(kWidth * kHeight), sky = hasSky ? (1 - stats.filled) * pixels : 0;
    stats.lit = std::clamp((float(lit) - sky) / (stats.filled * pixels), 0.0f, 1.0f);
    return stats;
}

std::vector<CameraSettings> cameraCandidates(const SceneState& state, const EmbreeScene& tracer) {
    const Geometry& g = state.geometry;
    std::vector<CameraSettings> cameras;
    for (const Box& box : boxesOf(g)) {
        const glm::vec3 center = 0.5f * (box.min + box.max), half = 0.5f * (box.max - box.min);
        const glm::vec3 along = half.x > half.z ? glm::vec3(half.x, 0, 0) : glm::vec3(0, 0, half.z);
        if (along != glm::vec3(0.0f) && isEnclosed(box, state, tracer))
            cameras.push_back(lookingFrom(center + 0.8f * along, center));
        for (const float up : {0.4f, 1.5f, -0.4f})
            for (int i = 0; i < 8; ++i) {
                const float angle = float(i) * glm::quarter_pi<float>(), c = std::cos(angle), s = std::sin(angle);
                cameras.push_back(outside(box, {0.6f * c - s, up, 0.6f * s + c}));
            }
        addInside(box, cameras);
    }
    // Remove cameras without a direction, as in flat boxes or because of rounding
    std::erase_if(cameras, [](const CameraSettings& camera) { return camera.position == camera.target; });
    return cameras;
}

}  // namespace voxray
