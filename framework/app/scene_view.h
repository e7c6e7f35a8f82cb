#pragma once

#include "config/settings.h"
#include "scene/geometry.h"
#include "trace/embree_scene.h"

namespace voxray {

/// A camera from which a scene without one can be looked at: inside, from its end, where its center is
/// enclosed by surfaces that look inwards; else outside, from where all of it is in view.
CameraSettings suggestCamera(const Geometry& geometry, const EmbreeScene& tracer);

/// The settings that describe a camera; its target is as far as the scene's center,
/// a tenth of the scene's diagonal at least.
CameraSettings settingsOf(const Camera& camera, const Geometry& geometry);

}  // namespace voxray
