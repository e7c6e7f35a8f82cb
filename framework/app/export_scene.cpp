#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/config_options.h"
#include "app/source_root.h"
#include "base/error.h"
#include "experiment/scene_files.h"
#include "experiment/session.h"
#include "experiment/variant_run.h"
#include "scene/builtin.h"
#include "scene/gltf_sidecar.h"
#include "scene/load.h"

namespace voxray {

namespace {

struct ExportArguments : ConfigArguments {
    std::filesystem::path file;
    std::filesystem::path target;
    std::optional<uint32_t> frame;
};

/// Moves surfaces, lights and camera to a measured frame.
void goToFrame(PreparedScene& scene, const Setup& setup, int number) {
    SceneLoader::goToFrame(scene, setup.scene, number);
    const Frame frame = frameOf(setup, scene, setup.general.seed);
    if (frame.moveCamera) frame.moveCamera(scene.camera, number);
    scene.state.cameras = {scene.camera};
}

/// Writes the pixels under each mask in white, as `<stem>.mask.<name>.png`.
void writeMasks(const std::vector<MaskSettings>& masks, const PreparedScene& scene, const ImageSettings& image,
                std::filesystem::path glb) {
    const std::filesystem::path stem = glb.replace_extension();
    for (const PixelSelection& mask : selectPixels(masks, scene.state, scene.camera, image.width, image.height))
        writePng(stem.string() + ".mask." + mask.name + ".png", maskPicture(mask, image.width, image.height));
}

void exportScene(const ExportArguments& arguments) {
    const std::vector<std::string> builtin = builtinSceneNames();
    if (isSceneFile(arguments.file) || std::ranges::count(builtin, arguments.file.string()) > 0)
        throw UsageError("{0}: export-scene takes a config; './voxray scene {0} --write-config OUT.yaml' writes one",
                         arguments.file.string());
    const Experiment experiment = loadExperiment(arguments.file, arguments.config);
    SceneLoader loader(sceneFolders(arguments.scenes, sourceRoot(), arguments.file));
    PreparedScene scene = loader.prepare(experiment.setup.scene);
    Value more = Value::map();
    if (arguments.frame) {
        goToFrame(scene, experiment.setup, int(*arguments.frame));
        more.set("frame", Value::fromScalar(std::to_string(*arguments.frame)));
    }
    for (const std::string& warning : loader.warnings()) fmt::print(stderr, "voxray: warning: {}\n", warning);
    const ImageSettings& image = experiment.setup.image;
    const ExportedView view{scene.camera, image.width, image.height, image.exposureStops};
    const std::filesystem::path sidecar = exportForRenderers(scene.state, view, arguments.target, more);
    writeMasks(experiment.measure.masks, scene, image, arguments.target);
    fmt::print("{}: {} triangles, {} lights; {}: camera, environment and what else glTF can't hold\n",
               arguments.target.string(), scene.state.geometry.triangles.size(), scene.state.lights.size(),
               sidecar.string());
}

}  // namespace

void addExportSceneCommand(CLI::App& app, int&) {
    CLI::App* command = app.add_subcommand(
        "export-scene",
        "Write what a config renders, camera and lights included, as glTF, with a side-car for what that can't hold, and "
        "an image of each mask. Sweeps are left out.");
    auto arguments = std::make_shared<ExportArguments>();
    command->add_option("CONFIG", arguments->file, "Config file.")->required();
    command->add_option("OUT.glb", arguments->target, "File to write.")->required()->check(endsWith(".glb"));
    command->add_option("--frame", arguments->frame,
                        "Frame of a scene that moves, the first measured one is 0; by default the scene at its time.");
    addConfigOptions(*command, *arguments);
    command->callback([arguments] { exportScene(*arguments); });
}

}  // namespace voxray
