#pragma once

#include <optional>
#include <string>

#include "config/settings.h"
#include "scene/geometry.h"
#include "trace/embree_scene.h"

namespace voxray {

/// A light for a scene of which a camera sees no lit surface: a lamp, or a sun with a dimmer sky.
struct SuggestedLight {
    std::string yaml;            ///< Entries of `scene`; "": the lights of the scene suffice.
    std::optional<Light> light;  ///< The lamp or the sun.
    float sky = 0;               ///< Radiance of the environment; 0: none.
};

/// A camera, and a light if necessary, with which a scene is visible.
struct SuggestedView {
    CameraSettings camera;
    SuggestedLight light;
};

/// The scene with a suggested light in addition to its own.
SceneState withLight(SceneState state, const SuggestedLight& light);

/// Searches a view that shows lit front sides of surfaces, from many positions outside and inside of the
/// scene. The first good one is returned: one from inside if the center is enclosed by surfaces that face
/// inwards, else one from outside. Deterministic.
SuggestedView suggestView(const SceneState& state, const EmbreeScene& tracer);

/// The view with which a config of a scene begins: its own camera if that sees light, or would see that of a sky, else
/// one that is searched.
struct FirstView {
    CameraSettings camera;
    SuggestedLight light;                   ///< What the camera needs.
    std::optional<CameraSettings> own;      ///< The scene's own camera.
    bool seesOwnLight = false;              ///< Whether the own camera sees the scene's own light.
    std::optional<SuggestedView> searched;  ///< If a view was searched.
    int exposureStops = 0;                  ///< That show the scene's own lights at medium brightness.
};
/// @param own a camera of the scene, if it has one. @param alwaysSearches even if the own camera sees light.
FirstView firstView(const SceneState& state, const EmbreeScene& tracer, const std::optional<Camera>& own,
                    bool alwaysSearches);

/// Whether a camera sees lit surfaces, and more front sides than back sides.
bool seesLight(const SceneState& state, const EmbreeScene& tracer, const CameraSettings& camera);

/// The settings of a camera. The distance of its target is that of the scene's center, at least a tenth of
/// the scene's diagonal, but not far behind the first surface.
CameraSettings settingsOf(const Camera& camera, const Geometry& geometry, const EmbreeScene& tracer);

/// "camera: {position: [0, 1, 4], ...}" with as many digits as necessary.
std::string yamlOf(const CameraSettings& camera);

}  // namespace voxray
