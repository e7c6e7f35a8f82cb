#pragma once

#include <string>

namespace voxray {

/// What a config to begin with says of its scene, as YAML.
struct FirstScene {
    std::string name;    ///< Of the experiment, and of the folder of its results.
    std::string source;  ///< "file: ..." or "builtin: ..."
    std::string camera;  ///< "camera: {...}"
    std::string light;   ///< "environment: 1" or "lights: [...]"; "" where the scene's own is seen.
};

/// A config that compares a lookup in voxels and gather rays with filtered path tracing: that of
/// docs/tutorial.md.
std::string firstConfig(const FirstScene& scene);

}  // namespace voxray
