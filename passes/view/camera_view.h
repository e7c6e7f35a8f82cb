#pragma once

#include "graph/pass.h"
#include "scene/camera_rays.h"

namespace voxray {

/// The camera and its samples in the image plane, as in camera_view.glsl.
struct CameraView {
    glm::vec3 origin;
    uint32_t width;
    glm::vec3 forward;
    uint32_t height;
    glm::vec3 right;
    glm::vec3 up;
};

/// @param extent samples of the view: texels of the G-buffer, or pixels.
inline CameraView cameraView(const Frame& frame, glm::uvec2 extent) {
    const CameraRays rays = cameraRays(frame.camera, frame.width, frame.height);
    return {rays.origin, extent.x, rays.forward, extent.y, rays.right, rays.up};
}

}  // namespace voxray
