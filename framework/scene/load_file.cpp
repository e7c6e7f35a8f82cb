#include "base/error.h"
#include "base/lower_case.h"
#include "scene/load.h"

namespace voxray {
namespace {

struct Format {
    const char* ending;
    std::shared_ptr<const Scene> (*load)(const std::filesystem::path&);
};
constexpr Format kFormats[] = {{".glb", loadGltf}, {".gltf", loadGltf}, {".xml", loadMitsuba}, {".pbrt", loadPbrt}};

const Format* formatOf(const std::filesystem::path& path) {
    for (const Format& format : kFormats)
        if (lowerCase(path.extension().string()) == format.ending) return &format;
    return nullptr;
}

}  // namespace

bool isSceneFile(const std::filesystem::path& path) {
    return formatOf(path) != nullptr;
}

std::shared_ptr<const Scene> loadSceneFile(const std::filesystem::path& path) {
    const Format* format = formatOf(path);
    // Files without one of these endings are tried as glTF, which knows its own by their first bytes
    return format ? format->load(path) : loadGltf(path);
}

}  // namespace voxray
