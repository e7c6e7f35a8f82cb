#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/config_options.h"
#include "app/source_root.h"
#include "base/error.h"
#include "experiment/scene_files.h"
#include "experiment/scene_setup.h"
#include "scene/builtin.h"
#include "scene/gltf_sidecar.h"
#include "scene/load.h"

namespace voxray {

namespace {

struct ExportArguments : ConfigArguments {
    std::filesystem::path file;
    std::filesystem::path target;
};

void exportScene(const ExportArguments& arguments) {
    const std::vector<std::string> builtin = builtinSceneNames();
    if (isSceneFile(arguments.file) || std::ranges::count(builtin, arguments.file.string()) > 0)
        throw UsageError("{0}: export-scene takes a config; './voxray scene {0} --write-config OUT.yaml' writes one",
                         arguments.file.string());
    const Experiment experiment = loadExperiment(arguments.file, arguments.config);
    SceneLoader loader(sceneFolders(arguments.scenes, sourceRoot(), arguments.file));
    const PreparedScene scene = loader.prepare(experiment.setup.scene);
    for (const std::string& warning : loader.warnings()) fmt::print(stderr, "voxray: warning: {}\n", warning);
    const ImageSettings& image = experiment.setup.image;
    const ExportedView view{scene.camera, image.width, image.height, image.exposureStops};
    const std::filesystem::path sidecar = exportForRenderers(scene.state, view, arguments.target, Value::map());
    fmt::print("{}: {} triangles, {} lights; {}: camera, environment and what else glTF can't hold\n",
               arguments.target.string(), scene.state.geometry.triangles.size(), scene.state.lights.size(),
               sidecar.string());
}

}  // namespace

void addExportSceneCommand(CLI::App& app, int&) {
    CLI::App* command = app.add_subcommand(
        "export-scene",
        "Write what a config renders, camera and lights included, as glTF, with a side-car for what that can't hold. "
        "Sweeps are left out.");
    auto arguments = std::make_shared<ExportArguments>();
    command->add_option("CONFIG", arguments->file, "Config file.")->required();
    command->add_option("OUT.glb", arguments->target, "File to write.")->required()->check(endsWith(".glb"));
    addConfigOptions(*command, *arguments);
    command->callback([arguments] { exportScene(*arguments); });
}

}  // namespace voxray
