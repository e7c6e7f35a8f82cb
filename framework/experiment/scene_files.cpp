#include "experiment/scene_files.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <optional>

#include "base/error.h"
#include "base/files.h"
#include "base/suggest.h"
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

}  // namespace

std::vector<fs::path> sceneFolders(const fs::path& scenesOption, const fs::path& sourceRoot,
                                   const fs::path& configFile) {
    std::vector<fs::path> folders;
    if (!scenesOption.empty()) folders.push_back(scenesOption);
    if (const char* variable = std::getenv("VOXRAY_SCENES"); variable && *variable)
        folders.push_back(variable);
    if (!sourceRoot.empty()) folders.push_back((sourceRoot / ".." / "shared" / "scenes").lexically_normal());
    if (!configFile.empty()) folders.push_back(configFile.has_parent_path() ? configFile.parent_path() : ".");
    // Each once, in this order
    std::vector<fs::path> once;
    for (const fs::path& folder : folders) {
        const auto isSame = [&](const fs::path& other) {
            return fs::weakly_canonical(other) == fs::weakly_canonical(folder);
        };
        if (std::ranges::none_of(once, isSame)) once.push_back(folder);
    }
    return once;
}

fs::path findSceneFile(const std::string& name, const std::vector<fs::path>& folders,
                       const TextLocation& where) {
    if (const auto path = lookUp(name, folders)) return *path;
    const bool isAbsolute = fs::path(name).is_absolute();
    std::vector<std::string> looked;
    const std::vector<std::string> builtin = builtinSceneNames();
    std::string advice;
    if (std::ranges::count(builtin, name) > 0)
        advice = fmt::format("; that scene is built in: write builtin: {}", name);
    for (const fs::path& folder : folders) {
        if (!isAbsolute) looked.push_back(folder.string());
        if (advice.empty()) advice = didYouMeanFile(name, folder);
    }
    if (advice.empty())
        advice = name.starts_with("~/") ? "; '~' stands for no folder here: write the whole path"
                 : name.find('$') != std::string::npos
                     ? "; '$' stands for no variable here: write the whole path"
                 : name.find('\\') != std::string::npos
                     ? "; write paths with '/'"
                     : "; name its folder with --scenes DIR or VOXRAY_SCENES, see docs/scenes.md";
    throw UsageError(where, "no file '{}'{}{}", oneLine(name, 200),
                     looked.empty() ? "" : fmt::format(" in {}", fmt::join(looked, ", ")), advice);
}

void checkBuiltin(const SceneSource& source, const std::vector<fs::path>& folders) {
    const std::string& name = source.builtin;
    const std::vector<std::string> names = builtinSceneNames();
    if (std::find(names.begin(), names.end(), name) == names.end()) {
        std::string advice = didYouMean(name, names);
        for (const char* ending : {"", ".gltf", ".glb"})
            if (const std::string file = name + ending; lookUp(file, folders))
                advice = fmt::format("; that is a file: write file: {}", file);
        throw UsageError(source.where, "{}.builtin: no built-in scene '{}'{}", source.owner, name, advice);
    }

    // Its own parameters, and in suggestions the keys that stand next to them
    std::vector<std::string> own, all = source.otherKeys;
    for (const ParameterDoc& doc : describeBuiltinScene(name)) own.push_back(doc.name);
    all.insert(all.end(), own.begin(), own.end());
    for (const auto& [key, value] : source.builtinParameters.members)
        if (std::find(own.begin(), own.end(), key) == own.end())
            throw UsageError(value.where, "{}: {} has no parameter '{}'{}", source.owner, name, key,
                             didYouMean(key, all));
}

void checkFormat(const SceneSource& source) {
    const std::string ending = fs::path(source.file).extension().string();
    for (const char* other : {".obj", ".fbx", ".blend", ".dae", ".ply", ".stl", ".usd", ".usdz", ".pbrt"})
        if (ending == other)
            throw UsageError(source.where, "{}.file: '{}' is no glTF: export it as .glb", source.owner,
                             oneLine(source.file, 200));
}

void checkMapFormat(const SceneSettings& settings) {
    const std::string ending = fs::path(settings.environment->map).extension().string();
    for (const char* other : {".png", ".jpg", ".jpeg", ".webp", ".tga", ".bmp"})
        if (ending == other)
            throw UsageError(settings.environmentWhere,
                             "scene.environment: '{}' holds no radiance: take an .exr file",
                             oneLine(settings.environment->map, 200));
}

}  // namespace voxray
