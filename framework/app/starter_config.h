#pragma once

#include <string>

#include "app/scene_view.h"
#include "config/settings.h"

namespace voxray {

/// The scene of a starter config, as parts of its YAML.
struct StarterScene {
    std::string name;    ///< Name of the experiment and of its results folder.
    std::string source;  ///< "file: ..." or "builtin: ..."
    std::string camera;  ///< "camera: {...}"
    std::string light;   ///< "environment: 1" or "lights: [...]"; "": the scene's own lights are visible.
    int exposureStops;
};
StarterScene starterScene(const std::string& name, const SceneSource& source, const FirstView& view);

/// The config of docs/tutorial.md, which compares voxel lookups and gather rays with filtered path tracing.
std::string starterConfig(const StarterScene& scene);

}  // namespace voxray
