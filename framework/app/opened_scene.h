#pragma once

#include <optional>
#include <vector>

#include "experiment/scene_setup.h"

namespace voxray {

/// A scene at its time, with or without a camera of its own.
struct OpenedScene {
    std::vector<Camera> cameras;  ///< Those of its file, in its coordinates.
    bool hasCamera = false;       ///< Whether its file or the settings bring one.
    PreparedScene prepared;       ///< Its camera is of no use where it has none.

    /// The camera that it begins with, if any.
    std::optional<Camera> ownCamera() const { return hasCamera ? std::optional(prepared.camera) : std::nullopt; }
};

/// @throws UsageError, Error as SceneLoader::prepare().
OpenedScene openScene(SceneLoader& loader, SceneSettings settings);

}  // namespace voxray
