#include "passes/common/view/camera_matrix.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace voxray {

glm::mat4 viewProjection(const Camera& camera, uint32_t width, uint32_t height, glm::vec3 boundsMin,
                         glm::vec3 boundsMax) {
    const float reach =
        glm::length(glm::max(glm::abs(camera.position - boundsMin), glm::abs(camera.position - boundsMax)));
    const float far = std::max(reach * 1.01f, 1e-3f);
    const float near = far * 1e-4f;
    const float aspect = float(width) / float(height);
    glm::mat4 projection = glm::perspective(camera.verticalFovRadians, aspect, near, far);
    projection[1][1] = -projection[1][1];
    return projection * glm::lookAt(camera.position, camera.position + camera.forward, camera.up);
}

}  // namespace voxray
