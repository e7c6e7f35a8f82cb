#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/schema.h"
#include "base/value.h"
#include "scene/compose.h"
#include "scene/material_change.h"

namespace voxray {

/// Where a scene comes from: a file or a built-in scene.
struct SceneSource {
    std::string file;
    std::string builtin;
    Value builtinParameters = Value::map();
    std::string owner;                   ///< For messages: "scene", "scene.add[0]".
    std::vector<std::string> otherKeys;  ///< What else may stand there: for "did you mean".
    TextLocation where;
    static constexpr auto schema() {
        return std::tuple{
            field("file", &SceneSource::file, "A .glb or .gltf file, looked for in the scene folders."),
            field("builtin", &SceneSource::builtin,
                  "A built-in scene; its own parameters stand next to it.")};
    }

    /// What the scene is called: the file's name without folder and ending, or the built-in scene's name.
    std::string name() const;
};

/// Takes the source out of a map: `file`, or `builtin` with every key that is not one of `otherKeys` as a
/// parameter.
/// @throws UsageError for an unknown key next to a file, and unless there is exactly one of the two.
SceneSource readSceneSource(const Value& map, const std::string& owner,
                            const std::vector<std::string>& otherKeys);

/// Reads `transform` of a scene or of an addition. @throws UsageError also for a scale of 0.
Placement readPlacement(const Value& map, const std::string& owner);

/// An entry of `scene.add`.
struct SceneAddition {
    SceneSource source;
    Placement placement;
    std::optional<MaterialSettings> material;  ///< Of all that is added; empty: its own materials.
};

/// An entry of `scene.override`.
struct MaterialOverride {
    std::string material;  ///< Name of the materials that it changes.
    MaterialChange change;
    TextLocation where;
};

/// Read `scene.add` and `scene.override`; null is none. @throws UsageError with file, line and the nearest
/// valid word.
std::vector<SceneAddition> readSceneAdditions(const Value& list);
std::vector<MaterialOverride> readMaterialOverrides(const Value& map);

}  // namespace voxray
