#pragma once

#include <vector>

#include "config/settings.h"
#include "scene/geometry.h"
#include "trace/embree_scene.h"

namespace voxray {

/// What a camera sees of a scene, by a few rays.
struct Sight {
    float filled = 0;    ///< Part of the view that shows surfaces.
    float fronts = 0;    ///< Part of these that show their fronts, or have no back.
    float near = 0;      ///< Part of these that are within a twentieth of what the farthest quarter is.
    float distance = 0;  ///< The median, m; 0 where nothing is seen.
    float lit = 0;       ///< Part of the surfaces seen that any light came from.

    /// From 0, nothing to see, to 1.
    float score() const;
    /// Whether it shows as much as a view needs.
    bool isGood() const { return filled >= 0.05f && fronts >= 0.6f && near < 0.3f && lit >= 0.5f; }
};

/// A camera as the path tracer takes it.
Camera cameraOf(const CameraSettings& settings);
/// Without light.
Sight lookAround(const SceneState& state, const EmbreeScene& tracer, const CameraSettings& camera);
/// With light, by path tracing.
Sight look(const SceneState& state, const EmbreeScene& tracer, const CameraSettings& camera);

/// Cameras to try, the likeliest first.
std::vector<CameraSettings> cameraCandidates(const SceneState& state, const EmbreeScene& tracer);

}  // namespace voxray
