#include "passes/common/view/camera_matrix.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace voxray {

glm::mat4 viewProjection(const Camera& camera, uint32_t width, uint32_t height, const Geometry& geometry) {
    const auto reach = [&](const glm::vec3& low, const glm::vec3& high) {
        const glm::vec3 farthest = glm::max(glm::abs(camera.position - low), glm::abs(camera.position - high));
        return std::max(glm::length(farthest) * 1.01f, 1e-3f);
    };
    const float far = reach(geometry.boundsMin, geometry.boundsMax);
    const float near = reach(geometry.region.min, geometry.region.max) * 1e-4f;
    const float aspect = float(width) / float(height);
    // Reversed depth: floats are dense around 0, the depth of the far plane
    glm::mat4 projection = glm::perspective(camera.verticalFovRadians, aspect, far, near);
    projection[1][1] = -projection[1][1];
    return projection * glm::lookAt(camera.position, camera.position + camera.forward, camera.up);
}

}  // namespace voxray
