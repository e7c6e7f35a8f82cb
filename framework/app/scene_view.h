#pragma once

#include <optional>
#include <string>

#include "config/settings.h"
#include "scene/geometry.h"
#include "trace/embree_scene.h"

namespace voxray {

/// What to write into `scene` to see something of it.
struct SuggestedView {
    CameraSettings camera;
    std::string light;          ///< "environment: 1", or a lamp at the camera; "" where what shines is seen.
    std::optional<Light> lamp;  ///< What `light` says, where that is a lamp.
};

/// A view of a scene that shows lit fronts of surfaces, found by looking from many places: from outside at
/// all of it and at its parts, and from inside. The first that is good is taken: from inside, where the
/// center is enclosed by surfaces that look inwards, else from outside. The same for the same scene.
SuggestedView suggestView(const SceneState& state, const EmbreeScene& tracer);

/// Whether a camera sees lit surfaces, and more fronts than backs.
bool seesLight(const SceneState& state, const EmbreeScene& tracer, const CameraSettings& camera);

/// The settings that describe a camera; its target is as far as the scene's center, a tenth of the scene's
/// diagonal at least, but not far behind what it looks at.
CameraSettings settingsOf(const Camera& camera, const Geometry& geometry, const EmbreeScene& tracer);

/// "camera: {position: [0, 1, 4], ...}", with as many digits as the view needs.
std::string yamlOf(const CameraSettings& camera);

}  // namespace voxray
