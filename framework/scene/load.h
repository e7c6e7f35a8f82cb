#pragma once

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/lower_case.h"
#include "base/schema.h"
#include "scene/geometry.h"
#include "scene/scene.h"

namespace voxray {

/// Loads a .glb or .gltf file. Unsupported features are named in Scene::warnings.
/// @throws Error with one line for a broken, truncated or malicious file, Interrupted.
std::shared_ptr<const Scene> loadGltf(const std::filesystem::path& path);

/// Loads a scene of Mitsuba 0.6 to 3 (.xml), with what it includes. What is approximated or left out is named in
/// Scene::warnings; docs/scenes.md lists what becomes of each plugin.
/// @throws Error with one line for a broken file, Interrupted.
std::shared_ptr<const Scene> loadMitsuba(const std::filesystem::path& path);

/// The same for a scene of pbrt-v4 (.pbrt).
std::shared_ptr<const Scene> loadPbrt(const std::filesystem::path& path);

/// Loads a scene by the ending of its file: .glb, .gltf, .xml or .pbrt.
std::shared_ptr<const Scene> loadSceneFile(const std::filesystem::path& path);

/// Endings of the files that are scenes.
inline constexpr std::array kSceneEndings{".glb", ".gltf", ".xml", ".pbrt"};

/// Whether a file's ending is one of these. Inline, as config asks without the scene's library.
inline bool isSceneFile(const std::filesystem::path& path) {
    return std::ranges::count(kSceneEndings, lowerCase(path.extension().string())) > 0;
}
inline constexpr const char* kSceneFileEndings = ".glb, .gltf, .xml, .pbrt";

/// Writes a scene at one time as .glb: geometry, materials, textures, lights and cameras as rendered (units:
/// docs/units.md), without the environment, which glTF can't hold: exportForRenderers() writes that, too.
/// @throws Error where the file can't be written.
void exportGlb(const SceneState& state, const std::filesystem::path& path);

/// Names of the built-in scenes, for help and "did you mean".
std::vector<std::string> builtinSceneNames();

/// Makes a built-in scene. @param params of that scene, e.g. {lights: spot} for cornell.
/// @throws UsageError for an unknown name or parameter.
std::shared_ptr<const Scene> makeBuiltinScene(const std::string& name, const Value& params);

/// Parameters of a built-in scene.
std::vector<ParameterDoc> describeBuiltinScene(const std::string& name);

/// The scene with all materials Lambert: metallic 0, specular 0, same base colour and emission.
std::shared_ptr<const Scene> withLambertMaterials(const Scene& scene);

}  // namespace voxray
