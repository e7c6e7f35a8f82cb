#pragma once

#include "scene/import/scene_import.h"
#include "scene/pbrt/description.h"

namespace voxray::pbrt {

/// Whether the camera shows our right-handed world mirrored: pbrt's own world is left-handed, unless its camera has a
/// negative scale.
bool showsMirrored(const Description& description);

/// Adds the camera, with the size of the film, and notes what of both is left out.
void addCamera(const Description& description, SceneImport& import);

}  // namespace voxray::pbrt
