#pragma once

#include "config/settings.h"

namespace voxray {

/// Reads `scene.camera.path` into settings whose other keys are read.
/// @throws UsageError for keys out of order, or where the camera would look along its 'up'.
void readCameraPath(const Value& list, CameraSettings& settings);

/// Whether the camera is elsewhere in other frames.
bool cameraMoves(const CameraSettings& settings);

/// The camera in a frame of its path, by the frame's index relative to the compared one: position and target go from
/// key to key along straight lines by equal steps. Before frame 0 and after the last key they rest.
CameraSettings cameraOnPath(const CameraSettings& settings, int frame);

}  // namespace voxray
