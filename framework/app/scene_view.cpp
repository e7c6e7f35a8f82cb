#include "app/scene_view.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

namespace voxray {
namespace {

constexpr int kRays = 200;
constexpr float kEnclosed = 0.7f;  ///< Part of the rays that must meet a surface that looks inwards.

// Points evenly spread over the sphere (Fibonacci lattice)
glm::vec3 directionOf(int ray) {
    const float z = 1 - (2 * float(ray) + 1) / kRays, angle = float(ray) * 2.39996323f;
    const float r = std::sqrt(1 - z * z);
    return {r * std::cos(angle), z, r * std::sin(angle)};
}

bool isEnclosed(glm::vec3 from, const Geometry& geometry, const EmbreeScene& tracer) {
    int inwards = 0;
    for (int i = 0; i < kRays; ++i) {
        const glm::vec3 direction = directionOf(i);
        const Hit hit = tracer.closestHit({from, 0, direction, std::numeric_limits<float>::infinity()});
        if (hit.triangle == Hit::kMiss) continue;
        const glm::uvec3 t = geometry.triangles[hit.triangle];
        const glm::vec3 a = geometry.positions[t.x];
        const glm::vec3 normal = glm::cross(geometry.positions[t.y] - a, geometry.positions[t.z] - a);
        inwards += glm::dot(normal, direction) < 0;
    }
    return float(inwards) >= kEnclosed * kRays;
}

}  // namespace

CameraSettings suggestCamera(const Geometry& geometry, const EmbreeScene& tracer) {
    const glm::vec3 center = 0.5f * (geometry.boundsMin + geometry.boundsMax);
    const glm::vec3 half = 0.5f * (geometry.boundsMax - geometry.boundsMin);
    CameraSettings camera;
    camera.target = center;
    if (isEnclosed(center, geometry, tracer)) {
        const glm::vec3 along = half.x > half.z ? glm::vec3(half.x, 0, 0) : glm::vec3(0, 0, half.z);
        camera.position = center + 0.8f * along;
    } else {
        const float distance = glm::length(half) / std::sin(glm::radians(camera.fovDegrees / 2));
        camera.position = center + distance * glm::normalize(glm::vec3(0.6f, 0.4f, 1.0f));
    }
    return camera;
}

CameraSettings settingsOf(const Camera& camera, const Geometry& geometry) {
    const glm::vec3 center = 0.5f * (geometry.boundsMin + geometry.boundsMax);
    CameraSettings settings;
    settings.position = camera.position;
    const float nearest = 0.1f * glm::length(geometry.boundsMax - geometry.boundsMin);
    settings.target = camera.position +
                      std::max(nearest, glm::dot(center - camera.position, camera.forward)) * camera.forward;
    settings.up = camera.up;
    settings.fovDegrees = glm::degrees(camera.verticalFovRadians);
    return settings;
}

}  // namespace voxray
