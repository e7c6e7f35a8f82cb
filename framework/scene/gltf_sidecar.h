#pragma once

#include <cstdint>
#include <filesystem>

#include "base/value.h"
#include "scene/geometry.h"

namespace voxray {

/// How a scene is looked at, as far as glTF has no place for it.
struct ExportedView {
    Camera camera;  ///< World space.
    uint32_t width = 0;
    uint32_t height = 0;
    float exposureStops = 0;  ///< Of previews.
};

/// Writes a scene at one time for other renderers: `glb`; next to it a JSON file of the same name, the side-car, with
/// what glTF can't hold (docs/external.md has its keys); and the environment's map, where there is one, as
/// `<stem>.environment.exr`. @param more further keys of the side-car. @return the side-car's path.
/// @throws Error as exportGlb().
std::filesystem::path exportForRenderers(const SceneState& state, const ExportedView& view,
                                         const std::filesystem::path& glb, const Value& more);

}  // namespace voxray
