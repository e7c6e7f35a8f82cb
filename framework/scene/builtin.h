#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/schema.h"
#include "scene/scene.h"

namespace voxray {

/// A built-in scene: name, factory and parameters.
struct BuiltinScene {
    const char* name;
    std::shared_ptr<const Scene> (*make)(const Value& params);
    std::vector<ParameterDoc> (*describe)();
};

/// Scenes by source file.
std::vector<BuiltinScene> roomScenes();        ///< cornell, still_life, thin_wall, mirror_room, mirror_row
std::vector<BuiltinScene> daylightScenes();    ///< window_room, shell_room
std::vector<BuiltinScene> clutterScenes();     ///< clutter
std::vector<BuiltinScene> closedFormScenes();  ///< furnace, white_room, quad_light, plane
std::vector<BuiltinScene> lampScenes();        ///< lamps, candles
std::vector<BuiltinScene> livingScenes();      ///< tree, figure
std::vector<BuiltinScene> movingScenes();      ///< spheres

/// Entry for a parameter struct that has `static constexpr const char* name` and `make(const Params&)`.
template <typename Params>
BuiltinScene builtinScene() {
    return {Params::name, [](const Value& params) { return make(readParams<Params>(params, Params::name)); },
            [] { return describeParams<Params>(); }};
}

}  // namespace voxray
