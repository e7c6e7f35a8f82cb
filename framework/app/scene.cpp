#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "app/commands.h"
#include "app/config_options.h"
#include "app/opened_scene.h"
#include "app/scene_view.h"
#include "app/source_root.h"
#include "app/starter_config.h"
#include "app/view_search.h"
#include "base/files.h"
#include "base/suggest.h"
#include "experiment/checks/view.h"
#include "experiment/pixel_masks.h"
#include "experiment/scene_files.h"
#include "experiment/scene_setup.h"
#include "passes/common/lights/light_sources.h"
#include "passes/path_trace/path_tracer.h"
#include "scene/builtin.h"
#include "scene/load.h"

namespace voxray {

namespace {

struct SceneArguments : ConfigArguments {
    std::filesystem::path what;
    std::filesystem::path picture;
    std::filesystem::path newConfig;
};

bool isConfig(const std::filesystem::path& what) {
    return what.extension() == ".yaml" || what.extension() == ".yml";
}

/// @throws UsageError for a name that no built-in scene has, with the most similar scene or file.
void checkName(const std::string& name, const std::vector<std::filesystem::path>& folders) {
    std::vector<std::string> names = builtinSceneNames();
    if (std::ranges::count(names, name) > 0) return;
    std::map<std::string, std::string> files;  // Names of files by their stems.
    std::error_code code;
    for (const std::filesystem::path& folder : folders)
        for (const auto& entry : std::filesystem::directory_iterator(folder, code))
            if (isSceneFile(entry.path()))
                files.try_emplace(entry.path().stem().string(), entry.path().filename().string());
    for (const auto& [stem, file] : files) names.push_back(stem);
    const std::string near = files.contains(name) ? name : nearest(name, names);
    if (near.empty()) throw UsageError("no built-in scene '{}'{}", name, didYouMean(name, names));
    throw UsageError("no built-in scene '{}'; did you mean '{}'?", name, files.contains(near) ? files.at(near) : near);
}

/// Settings for the scene of a config, a scene file, or a built-in scene.
SceneSettings settingsOf(const SceneArguments& arguments, const std::vector<std::filesystem::path>& folders) {
    if (isConfig(arguments.what)) return loadExperiment(arguments.what, arguments.config).setup.scene;
    if (!arguments.config.profile.empty() || !arguments.config.assignments.empty())
        throw UsageError("--profile and --set change a config; {} is a scene", arguments.what.string());
    const bool isFile = isSceneFile(arguments.what);
    if (!isFile) checkName(arguments.what.string(), folders);
    Value map = Value::map();
    const bool isHere = isFile && std::filesystem::exists(arguments.what);
    map.set(isFile ? "file" : "builtin",
            Value::fromScalar((isHere ? absolute(arguments.what) : arguments.what).string(), true));
    return readSceneSettings(map);
}

/// Area (m²) and number of triangles of each material.
std::vector<std::pair<double, size_t>> materialUses(const SceneState& state) {
    const Geometry& g = state.geometry;
    std::vector<std::pair<double, size_t>> uses(state.scene->materials.size());
    for (size_t i = 0; i < g.triangles.size(); ++i) {
        auto& [area, count] = uses[g.triangleMaterials[i]];
        area += triangleArea(g, uint32_t(i));
        ++count;
    }
    return uses;
}

bool emits(const Material& material) {
    return material.emission != glm::vec3(0.0f);
}

/// Prints lights, emissive materials and environment. @return whether there are any.
bool printLights(const SceneState& state) {
    const Environment& environment = state.scene->environment;
    const bool hasEnvironment = environment.radiance != glm::vec3(0.0f);
    const auto uses = materialUses(state);
    size_t emissive = 0;
    for (size_t i = 0; i < uses.size(); ++i) emissive += emits(state.scene->materials[i]) && uses[i].first > 0;
    fmt::print("lights: {} punctual, {} emissive material{}, {} environment\n", state.lights.size(), emissive,
               emissive == 1 ? "" : "s", hasEnvironment ? "an" : "no");
    for (const Light& light : state.lights) {
        const char* name = light.type == LightType::Point  ? "point"
                           : light.type == LightType::Spot ? "spot"
                                                           : "directional";
        if (light.type == LightType::Directional)
            fmt::print("  - {{{}: {}, irradiance: {}}}  # W/m²\n", name, bracketed(light.direction),
                       bracketed(light.intensity));
        else
            fmt::print("  - {{{}: {}, {}intensity: {}}}  # W/sr\n", name, bracketed(light.position),
                       light.type == LightType::Spot ? "direction: " + bracketed(light.direction) + ", " : "",
                       bracketed(light.intensity));
    }
    if (hasEnvironment)
        fmt::print("  environment {}{}\n", bracketed(environment.radiance),
                   environment.map ? " times a map" : " W/(m² sr)");
    return emissive > 0 || hasEnvironment || !state.lights.empty();
}

void printMaterials(const SceneState& state) {
    const auto uses = materialUses(state);
    fmt::print("materials: {}\n  {:32} {:>10} {:>10}  {:22} {:>8} {:>9}\n", uses.size(), "name", "triangles",
               "area, m²", "base color", "metallic", "roughness");
    for (size_t i = 0; i < uses.size(); ++i) {
        const Material& m = state.scene->materials[i];
        fmt::print("  {:32} {:10} {:10.3g}  {:22} {:8.2g} {:9.2g}{}{}\n", m.name, uses[i].second, uses[i].first,
                   bracketed(glm::vec3(m.baseColor)), m.metallic, m.roughness,
                   m.baseColorTexture.texture >= 0 ? ", textured" : "",
                   emits(m) ? ", emits " + bracketed(m.emission) + " W/(m² sr)" : "");
    }
}

/// Prints names of objects, as they are used in `measure.masks`.
void printObjects(const Scene& scene) {
    constexpr size_t kListed = 20;
    std::vector<std::string> names = objectNames(scene);
    const size_t more = names.size() - std::min(names.size(), kListed);
    names.resize(names.size() - more);
    fmt::print("objects: {}{}\n", names.empty() ? "none has a name" : fmt::format("'{}'", fmt::join(names, "', '")),
               more > 0 ? fmt::format(" and {} more", more) : "");
}

/// Writes a path-traced picture of a few samples. @param added a light that is proposed, or none
void writePicture(const SceneState& scene, const EmbreeScene& tracer, const Camera& camera, const SuggestedLight& added,
                  bool isLit, const std::filesystem::path& file) {
    const PathTraceOptions options{.width = 320, .height = 180, .spp = 32, .bounces = 4};
    writePng(file, preview(pathTrace(withLight(scene, added), tracer, camera, options).total, 0));
    fmt::print("{}: 320 x 180 pixels{}\n", file.string(),
               !added.yaml.empty() ? ", by the light that is proposed"
               : isLit             ? ""
                                   : ", nearly all black: its camera sees none of what shines");
}

/// Writes a config of the scene. @throws UsageError if the file exists.
void writeConfig(const std::filesystem::path& file, const SceneSource& source, const FirstView& view) {
    if (std::filesystem::exists(file))
        throw UsageError("{}: it is there already; give another name, or remove it", file.string());
    writeFileAtomically(file, starterConfig(starterScene(file.stem().string(), source, view)));
    fmt::print("{0}: a config of this scene; './voxray run {0}' renders it and makes a report\n", file.string());
}

void describe(const SceneArguments& arguments) {
    if (!arguments.newConfig.empty() && isConfig(arguments.what))
        throw UsageError("--write-config writes a config of a scene; {} is a config", arguments.what.string());
    const auto folders = sceneFolders(arguments.scenes, sourceRoot(), arguments.what);
    const SceneSettings settings = settingsOf(arguments, folders);
    SceneLoader loader(folders);
    OpenedScene opened = openScene(loader, settings);
    PreparedScene& scene = opened.prepared;
    const bool hasCamera = opened.hasCamera;
    const Geometry& g = scene.state.geometry;
    const EmbreeScene tracer(scene.state);

    const glm::vec3 size = g.boundsMax - g.boundsMin;
    const size_t objects = scene.state.scene->instances.size();
    fmt::print("{}: {} triangles in {} object{}, {} textures\n", arguments.what.string(), g.triangles.size(), objects,
               objects == 1 ? "" : "s", scene.state.scene->textures.size());
    if (const auto& panes = scene.state.panes)
        fmt::print("panes: {} triangles that light passes straight (docs/units.md), not counted above or below\n",
                   panes->geometry.triangles.size());
    fmt::print("bounds: {} to {}, {:.4g} x {:.4g} x {:.4g} m\n", bracketed(g.boundsMin), bracketed(g.boundsMax), size.x,
               size.y, size.z);
    fmt::print("cameras: {}\n", opened.cameras.size());
    for (const Camera& camera : opened.cameras)
        fmt::print("  '{}'  {}\n", camera.name, yamlOf(settingsOf(camera, g, tracer)));
    const bool hasLight = printLights(scene.state);
    printMaterials(scene.state);
    printObjects(*scene.state.scene);

    // Suggest a camera and a light
    const FirstView first =
        firstView(scene.state, tracer, opened.ownCamera(), settings.camera && opened.cameras.empty());
    if (first.own) fmt::print("the camera in use:\n  {}\n", yamlOf(*first.own));
    SuggestedLight added;
    if (const auto& view = first.searched) {
        fmt::print("{}:\n  {}\n", hasCamera ? "another camera, which sees more" : "a camera to begin with",
                   yamlOf(view->camera));
        const SuggestedLight& light = first.seesOwnLight ? view->light : first.light;
        if (!light.yaml.empty())
            fmt::print("{}; write under 'scene'\n  {}\n", hasLight ? "no light is seen from there" : "nothing shines",
                       light.yaml);
        if (!hasCamera) scene.camera = cameraOf(view->camera);
        if (!first.seesOwnLight && (!hasCamera || !hasLight)) added = light;
    }
    for (const std::string& warning : loader.warnings()) fmt::print(stderr, "voxray: warning: {}\n", warning);
    if (!arguments.picture.empty())
        writePicture(scene.state, tracer, scene.camera, added,
                     first.seesOwnLight || (!hasCamera && first.light.yaml.empty()), arguments.picture);
    if (!arguments.newConfig.empty()) writeConfig(arguments.newConfig, settings.source, first);
}

}  // namespace

void addSceneCommand(CLI::App& app, int&) {
    CLI::App* command = app.add_subcommand("scene",
                                           "Tell what is in a scene: bounds, cameras, lights, materials, "
                                           "names of objects, and a camera to paste.");
    auto arguments = std::make_shared<SceneArguments>();
    command
        ->add_option("SCENE", arguments->what,
                     "A .glb, .gltf, .xml or .pbrt file, the name of a built-in scene, or a config, "
                     "whose scene it is with all that the config changes. Sweeps are left out.")
        ->required();
    command->add_option("--picture", arguments->picture, "Write a small path-traced picture.")
        ->type_name("OUT.png")
        ->check(endsWith(".png"));
    command
        ->add_option("--write-config", arguments->newConfig,
                     "Write a config to begin with: "
                     "this scene, a camera, a light where none is seen, and methods to compare.")
        ->type_name("OUT.yaml")
        ->check(endsWith(".yaml"));
    addConfigOptions(*command, *arguments);
    command->callback([arguments] { describe(*arguments); });
}

}  // namespace voxray
