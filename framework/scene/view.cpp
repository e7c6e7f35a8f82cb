#include "scene/view.h"

#include <algorithm>
#include <array>
#include <vector>

#include "scene/camera_rays.h"

namespace voxray {
namespace {

/// Clips a convex polygon to the positive side of a plane through the origin.
void clip(std::vector<glm::vec3>& polygon, const glm::vec3& normal) {
    std::vector<glm::vec3> clipped;
    for (size_t i = 0; i < polygon.size(); ++i) {
        const glm::vec3 &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
        const float a = glm::dot(from, normal), b = glm::dot(to, normal);
        if (a > 0) clipped.push_back(from);
        if ((a > 0) != (b > 0)) clipped.push_back(from + (a / (a - b)) * (to - from));
    }
    polygon = std::move(clipped);
}

}  // namespace

bool isInView(const Geometry& geometry, const Camera& camera, uint32_t width, uint32_t height) {
    // Frustum planes through the camera, normals inwards
    const CameraRays rays = cameraRays(camera, width, height);
    const std::array<glm::vec3, 4> corners{rays.direction(0, 0), rays.direction(1, 0), rays.direction(1, 1),
                                           rays.direction(0, 1)};
    std::array<glm::vec3, 4> normals;
    for (size_t i = 0; i < 4; ++i) {
        normals[i] = glm::cross(corners[i], corners[(i + 1) % 4]);
        if (glm::dot(normals[i], rays.forward) < 0) normals[i] = -normals[i];
    }
    std::vector<glm::vec3> polygon;
    return std::ranges::any_of(geometry.triangles, [&](const glm::uvec3& triangle) {
        polygon = {geometry.positions[triangle.x] - rays.origin, geometry.positions[triangle.y] - rays.origin,
                   geometry.positions[triangle.z] - rays.origin};
        for (const glm::vec3& normal : normals) clip(polygon, normal);
        return !polygon.empty();
    });
}

}  // namespace voxray
