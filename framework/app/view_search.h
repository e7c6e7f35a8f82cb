#pragma once

#include <vector>

#include "config/settings.h"
#include "scene/geometry.h"
#include "trace/embree_scene.h"

namespace voxray {

/// What a camera sees of a scene, from a few rays.
struct ViewStats {
    float filled = 0;    ///< Fraction of the view that shows surfaces.
    float fronts = 0;    ///< Fraction of these surfaces that show their front side or are double-sided.
    float near = 0;      ///< Fraction of these closer than a twentieth of the 75th percentile of distances.
    float distance = 0;  ///< Median distance, m; 0 if nothing is visible.
    float lit = 0;       ///< Fraction of visible surfaces with radiance over 0.

    /// Quality of the view, 0 to 1. @param leastDistance below which a view shows little of the scene, m
    float score(float leastDistance) const;
    /// Whether the view is good enough to stop the search.
    bool isGood(float leastDistance) const {
        return filled >= 0.05f && fronts >= 0.6f && near < 0.3f && lit >= 0.5f && distance >= leastDistance;
    }
};

/// The distance below which a view shows little of the scene: a wall before the camera.
float leastDistance(const SceneState& state);
/// Computes all members except `lit`.
ViewStats measureGeometry(const SceneState& state, const EmbreeScene& tracer, const CameraSettings& camera);
/// Computes all members. `lit` is found by path tracing.
ViewStats measureView(const SceneState& state, const EmbreeScene& tracer, const CameraSettings& camera);

/// Candidates of cameras, the most promising ones first.
std::vector<CameraSettings> cameraCandidates(const SceneState& state, const EmbreeScene& tracer);

}  // namespace voxray
