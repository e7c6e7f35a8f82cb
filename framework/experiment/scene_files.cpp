#include "experiment/scene_files.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "base/error.h"
#include "base/files.h"
#include "base/interrupt.h"
#include "base/suggest.h"
#include "experiment/scene_setup.h"
#include "image/image.h"
#include "scene/content_hash.h"
#include "scene/load.h"

namespace voxray {
namespace fs = std::filesystem;

namespace {

std::optional<fs::path> lookUp(const fs::path& name, const std::vector<fs::path>& folders) {
    std::error_code code;
    if (name.is_absolute()) return fs::exists(name, code) ? std::optional(name) : std::nullopt;
    for (const fs::path& folder : folders)
        if (fs::exists(folder / name, code)) return folder / name;
    return std::nullopt;
}

/// Calls read() for a file that the config names. Errors are reported with the line of the config.
template <typename Read>
auto readAt(const TextLocation& where, const Read& read) {
    try {
        return read();
    } catch (const Interrupted&) {
        throw;
    } catch (const Error& error) {
        throw UsageError(where, "{}", error.what());
    }
}

/// The path of a file in the first folder that has it; absolute names are returned as they are.
/// @throws UsageError at `where` with the folders that were searched.
fs::path findSceneFile(const std::string& name, const std::vector<fs::path>& folders, const TextLocation& where) {
    if (const auto path = lookUp(name, folders)) return *path;
    const bool isAbsolute = fs::path(name).is_absolute();
    std::vector<std::string> searched;
    const std::vector<std::string> builtin = builtinSceneNames();
    std::string advice;
    if (std::ranges::count(builtin, name) > 0)
        advice = fmt::format("; that scene is built in: write builtin: {}", name);
    for (const fs::path& folder : folders) {
        if (!isAbsolute) searched.push_back(folder.string());
        if (advice.empty()) advice = didYouMeanFile(name, folder);
    }
    if (advice.empty())
        advice = name.starts_with("~/")                ? "; '~' stands for no folder here: write the whole path"
                 : name.find('$') != std::string::npos ? "; '$' stands for no variable here: write the whole path"
                 : name.find('\\') != std::string::npos
                     ? "; write paths with '/'"
                     : "; name its folder with --scenes DIR or VOXRAY_SCENES, see docs/scenes.md";
    throw UsageError(where, "no file '{}'{}{}", oneLine(name, 200),
                     searched.empty() ? "" : fmt::format(" in {}", fmt::join(searched, ", ")), advice);
}

/// @throws UsageError for a built-in scene that doesn't exist or has no such parameters.
void checkBuiltin(const SceneSource& source, const std::vector<fs::path>& folders) {
    const std::string& name = source.builtin;
    const std::vector<std::string> names = builtinSceneNames();
    if (std::ranges::count(names, name) == 0) {
        std::string advice = didYouMean(name, names);
        for (const char* ending : {"", ".gltf", ".glb", ".xml", ".pbrt"})
            if (const std::string file = name + ending; lookUp(file, folders))
                advice = fmt::format("; that is a file: write file: {}", file);
        throw UsageError(source.where, "{}.builtin: no built-in scene '{}'{}", source.owner, name, advice);
    }

    // Suggestions include keys that all scenes have
    std::vector<std::string> parameters, all = source.otherKeys;
    for (const ParameterDoc& doc : describeBuiltinScene(name)) parameters.push_back(doc.name);
    all.insert(all.end(), parameters.begin(), parameters.end());
    for (const auto& [key, value] : source.builtinParameters.members)
        if (std::ranges::count(parameters, key) == 0)
            throw UsageError(value.where, "{}: {} has no parameter '{}'{}", source.owner, name, key,
                             didYouMean(key, all));
}

/// @throws UsageError if the extension of the file is that of a format that no reader knows.
void checkFormat(const SceneSource& source) {
    const std::string ending = fs::path(source.file).extension().string();
    for (const char* unsupported : {".obj", ".fbx", ".blend", ".dae", ".ply", ".stl", ".usd", ".usdz"})
        if (ending == unsupported)
            throw UsageError(source.where, "{}.file: '{}' is none of {}: export it as .glb", source.owner,
                             oneLine(source.file, 200), kSceneFileEndings);
}

/// @throws UsageError if the extension of the environment map is that of an LDR format, which has no
/// radiance.
void checkMapFormat(const SceneSettings& settings) {
    const std::string ending = fs::path(settings.environment->map).extension().string();
    for (const char* ldr : {".png", ".jpg", ".jpeg", ".webp", ".tga", ".bmp"})
        if (ending == ldr)
            throw UsageError(settings.environmentWhere, "scene.environment: '{}' holds no radiance: take an .exr file",
                             oneLine(settings.environment->map, 200));
}

}  // namespace

std::vector<fs::path> sceneFolders(const fs::path& scenesOption, const fs::path& sourceRoot,
                                   const fs::path& configFile) {
    std::vector<fs::path> folders;
    if (!scenesOption.empty()) folders.push_back(scenesOption);
    if (const char* variable = std::getenv("VOXRAY_SCENES"); variable && *variable) folders.push_back(variable);
    if (!sourceRoot.empty()) folders.push_back((sourceRoot / ".." / "shared" / "scenes").lexically_normal());
    if (!configFile.empty()) folders.push_back(configFile.has_parent_path() ? configFile.parent_path() : ".");
    std::vector<fs::path> unique;
    for (const fs::path& folder : folders) {
        const auto isSame = [&](const fs::path& other) {
            return fs::weakly_canonical(other) == fs::weakly_canonical(folder);
        };
        if (std::ranges::none_of(unique, isSame)) unique.push_back(folder);
    }
    return unique;
}

void checkRadiance(const ImageF& map, const std::filesystem::path& path) {
    if (map.channels != 3) throw Error("{}: an environment map has three channels", path.string());
    size_t bad = 0, first = 0;
    for (size_t i = map.data.size(); i-- > 0;)
        if (!std::isfinite(map.data[i]) || map.data[i] < 0) {
            ++bad;
            first = i;
        }
    if (bad == 0) return;
    const size_t pixel = first / 3;
    throw Error(
        "{}: its pixel in column {} and row {}, from the upper left, is ({}, {}, {}), "
        "and {} of its {} values are negative or not finite: radiance is neither; repair it in an image editor{}",
        path.string(), pixel % map.width, pixel / map.width, map.data[3 * pixel], map.data[3 * pixel + 1],
        map.data[3 * pixel + 2], bad, map.data.size(),
        std::isinf(map.data[first]) ? "; half floats end at 65504, save a sun in 32 bits" : "");
}

std::shared_ptr<const Scene> SceneLoader::load(const SceneSource& source) {
    if (!source.builtin.empty()) {
        const std::string id = "builtin:" + source.builtin + source.builtinParameters.text();
        auto& scene = scenes_[id];
        if (!scene) {
            checkBuiltin(source, folders_);
            scene = makeBuiltinScene(source.builtin, source.builtinParameters);
        }
        return scene;
    }
    checkFormat(source);
    const fs::path path = findSceneFile(source.file, folders_, source.where);
    auto& scene = scenes_[path.string()];
    if (!scene) scene = readAt(source.where, [&] { return loadSceneFile(path); });
    return scene;
}

std::shared_ptr<const ImageF> SceneLoader::loadMap(const SceneSettings& settings) {
    if (!settings.environment || settings.environment->map.empty()) return nullptr;
    checkMapFormat(settings);
    const fs::path path = findSceneFile(settings.environment->map, folders_, settings.environmentWhere);
    const std::string& layer = settings.environment->layer;
    auto& map = maps_[{path.string(), layer}];
    if (!map) {
        map = readAt(settings.environmentWhere, [&] {
            LayeredImage read = readLayer(path, layer);
            checkRadiance(read.image, path);
            if (layer.empty() && read.layerCount > 1 && !read.layer.empty())
                mapWarnings_.push_back(fmt::format("{}: its layer '{}' of {} is the environment",
                                                   path.filename().string(), read.layer, read.layerCount));
            return std::make_shared<const ImageF>(std::move(read.image));
        });
    }
    return map;
}

std::string SceneLoader::key(const SceneSettings& settings) {
    Hasher hasher;
    hasher.add(load(settings.source)->contentHash);
    if (settings.placement) hasher.add("transform").add(writeParams(*settings.placement).text());
    for (const auto& [source, placement, material, swing] : settings.additions)
        hasher.add("add")
            .add(load(source)->contentHash)
            .add(source.name())
            .add(writeParams(placement).text())
            .add(material ? writeParams(*material).text() : "")
            .add(swing ? writeParams(*swing).text() : "");
    checkOverrides(settings);
    for (const auto& [name, change, where] : settings.overrides)
        hasher.add("override")
            .add(name)
            .add(writeParams(change.settings).text())
            .add(fmt::format("{}", fmt::join(change.keys, " ")));
    for (const HiddenName& hidden : settings.hidden) hasher.add("hide").add(hidden.name);
    hasher.addPlain(settings.options.keepFileLights).addPlain(settings.options.materials);
    if (settings.options.subdivide > 0) hasher.add("subdivide").addPlain(settings.options.subdivide);
    hasher.addPlain(settings.options.time).add(settings.cameraName);
    // The compared frame depends on later motion only through the bounds of the scene
    hasher.addPlain(settings.options.timeStep > 0);
    hasher.add(settings.movingSpheres ? writeParams(*settings.movingSpheres).text() : "");
    hasher.add(settings.region ? writeParams(*settings.region).text() : "");
    Value camera = settings.camera ? writeParams(*settings.camera) : Value();
    camera.erase("move");
    hasher.add(settings.camera ? camera.text() : "");
    for (const auto& [light, move, offAt, where] : settings.lights) {
        hasher.addPlain(light.type).addPlain(light.intensity).addPlain(light.position).addPlain(light.direction);
        hasher.addPlain(light.innerConeAngle).addPlain(light.outerConeAngle);
    }
    hasher.add(settings.environment ? fmt::format("{}", writeParams(*settings.environment).find("scale")->text()) : "");
    if (const auto map = loadMap(settings)) {
        hasher.addPlain(map->width).addPlain(map->height);
        hasher.add(map->data.data(), map->data.size() * sizeof(float));
    }
    return hasher.hex();
}

}  // namespace voxray
