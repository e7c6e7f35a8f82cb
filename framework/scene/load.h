#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/schema.h"
#include "scene/geometry.h"
#include "scene/scene.h"

namespace voxray {

/// Loads a .glb or .gltf file. One clear line for a broken, truncated or hostile file, never a crash.
/// Features that are left out (skins, morph targets, unknown extensions) are named in Scene::warnings.
/// @throws Error naming the file and what is wrong with it, Interrupted.
std::shared_ptr<const Scene> loadGltf(const std::filesystem::path& path);

/// Writes a scene at one time as .glb: geometry, materials, textures, lights, cameras, exactly as rendered
/// (conventions as in docs/units.md). @throws Error for an environment that glTF can't carry.
void exportGlb(const SceneState& state, const std::filesystem::path& path);

/// Names of the built-in scenes, for help and "did you mean".
std::vector<std::string> builtinSceneNames();

/// Makes a built-in scene. `params` are the scene's own parameters, e.g. {lights: spot} for cornell.
/// @throws UsageError for an unknown name or parameter.
std::shared_ptr<const Scene> makeBuiltinScene(const std::string& name, const Value& params);

/// Parameters of a built-in scene.
std::vector<ParameterDoc> describeBuiltinScene(const std::string& name);

/// The scene with every material made Lambert: metallic 0, specular 0, base colour and emission kept.
std::shared_ptr<const Scene> withLambertMaterials(const Scene& scene);

}  // namespace voxray
