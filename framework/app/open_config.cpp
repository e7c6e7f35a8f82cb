#include "app/open_config.h"

#include <string>

#include "app/opened_scene.h"
#include "app/scene_view.h"
#include "app/source_root.h"
#include "app/starter_config.h"
#include "config/yaml.h"
#include "experiment/scene_files.h"
#include "scene/load.h"

namespace voxray {

Experiment openConfig(const std::filesystem::path& file, ConfigArguments arguments, const std::string& tracer) {
    if (!tracer.empty()) arguments.config.assignments.push_back("tracer=" + tracer);
    if (!isSceneFile(file)) {
        if (!std::filesystem::exists(file))
            throw UsageError("no file '{}'; give a config (.yaml) or a scene file ({})", file.string(),
                             kSceneFileEndings);
        return loadExperiment(file, arguments.config);
    }
    Value keys = Value::map();
    keys.set("file", Value::fromScalar((std::filesystem::exists(file) ? absolute(file) : file).string(), true));
    const SceneSettings settings = readSceneSettings(keys);
    SceneLoader loader(sceneFolders(arguments.scenes, sourceRoot(), file));
    const OpenedScene scene = openScene(loader, settings);
    const SceneState& state = scene.prepared.state;
    const FirstView view = firstView(state, EmbreeScene(state), scene.ownCamera(), false);
    const std::string name = file.stem().string();
    Value config = parseYaml(starterConfig(starterScene(name, settings.source, view)), "");
    locate(config, {file.filename().string()});  // Its lines are in no file
    return readExperiment(config, arguments.config);
}

}  // namespace voxray
