#pragma once

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "scene/scene.h"

namespace voxray {

/// A pinhole camera's image plane at unit distance. Direction of a pixel's center:
///
///     forward + (2 (x + 0.5) / width - 1) * right + (1 - 2 (y + 0.5) / height) * up
struct CameraRays {
    glm::vec3 origin, forward, right, up;

    /// Direction through the image point (x, y), 0 to 1; (0, 0) is the upper left corner. Its component along
    /// `forward` is 1.
    glm::vec3 direction(float x, float y) const { return forward + (2.0f * x - 1.0f) * right + (1.0f - 2.0f * y) * up; }
};

inline CameraRays cameraRays(const Camera& camera, uint32_t width, uint32_t height) {
    const float halfHeight = std::tan(0.5f * camera.verticalFovRadians);
    const glm::vec3 right = glm::normalize(glm::cross(camera.forward, camera.up));
    return {camera.position, camera.forward, right * (halfHeight * float(width) / float(height)),
            camera.up * halfHeight};
}

}  // namespace voxray
