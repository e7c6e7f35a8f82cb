#include "app/open_config.h"

#include <optional>
#include <string>

#include "app/scene_view.h"
#include "app/source_root.h"
#include "app/starter_config.h"
#include "experiment/scene_files.h"
#include "experiment/scene_setup.h"

namespace voxray {

Experiment openConfig(const std::filesystem::path& file, ConfigArguments arguments, const std::string& tracer) {
    if (!tracer.empty()) arguments.config.assignments.push_back("tracer=" + tracer);
    if (!isSceneFile(file)) return loadExperiment(file, arguments.config);
    Value keys = Value::map();
    keys.set("file", Value::fromScalar((std::filesystem::exists(file) ? absolute(file) : file).string(), true));
    SceneSettings settings = readSceneSettings(keys);
    SceneLoader loader(sceneFolders(arguments.scenes, sourceRoot(), file));
    const bool hasCamera = !evaluate(loader.load(settings.source), 0).cameras.empty();
    if (!hasCamera) settings.camera.emplace().target = {0, 0, -1};  // Replaced below
    const PreparedScene scene = loader.prepare(settings);
    const std::optional<Camera> own = hasCamera ? std::optional(scene.camera) : std::nullopt;
    const FirstView view = firstView(scene.state, EmbreeScene(scene.state), own, false);
    const std::string name = file.stem().string();
    const std::string text = starterConfig(starterScene(name, settings.source, view.camera, view.light));
    return parseExperiment(text, "starter config of " + file.filename().string(), arguments.config);
}

}  // namespace voxray
