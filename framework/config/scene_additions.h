#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/schema.h"
#include "base/value.h"
#include "scene/compose.h"
#include "scene/material_change.h"
#include "scene/swing.h"

namespace voxray {

/// Source of a scene: a file or a built-in scene.
struct SceneSource {
    std::string file;
    std::string builtin;
    Value builtinParameters = Value::map();
    std::string owner;                   ///< Path for messages, e.g. "scene" or "scene.add[0]".
    std::vector<std::string> otherKeys;  ///< Other valid keys, for suggestions.
    TextLocation where;
    static constexpr auto schema() {
        return std::tuple{
            field("file", &SceneSource::file,
                  "A .glb, .gltf, .xml (Mitsuba) or .pbrt file, looked for in the scene folders."),
            field("builtin", &SceneSource::builtin, "A built-in scene; its own parameters stand next to it.")};
    }

    /// The file's name without folder and extension, or the built-in scene's name.
    std::string name() const;
};

/// Reads the source in a map: `file`, or `builtin` with all keys except `otherKeys` as parameters.
/// @throws UsageError for an unknown key next to a file, and unless exactly one of the two is given.
SceneSource readSceneSource(const Value& map, const std::string& owner, const std::vector<std::string>& otherKeys);

/// Reads `transform` of a scene or of an addition. @throws UsageError also for a scale of 0.
Placement readPlacement(const Value& map, const std::string& owner);

/// An entry of `scene.add`.
struct SceneAddition {
    SceneSource source;
    Placement placement;
    std::optional<MaterialSettings> material;  ///< Replaces all added materials; empty: none.
    std::optional<Swing> swing;                ///< Of all that is added; empty: it stays.
};

/// An entry of `scene.override`.
struct MaterialOverride {
    std::string material;  ///< Name of the changed materials.
    MaterialChange change;
    TextLocation where;
};

/// Read `scene.add` and `scene.override`; null: none. @throws UsageError with file, line and the nearest
/// valid word.
std::vector<SceneAddition> readSceneAdditions(const Value& list);
std::vector<MaterialOverride> readMaterialOverrides(const Value& map);

}  // namespace voxray
