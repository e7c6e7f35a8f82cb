#include "scene/load.h"

namespace voxray {

std::shared_ptr<const Scene> loadSceneFile(const std::filesystem::path& path) {
    constexpr std::array loaders{loadGltf, loadGltf, loadMitsuba, loadPbrt};
    static_assert(loaders.size() == kSceneEndings.size());
    const auto ending = std::ranges::find(kSceneEndings, lowerCase(path.extension().string()));
    // Files without one of these endings are tried as glTF, which knows its own by their first bytes
    return ending == kSceneEndings.end() ? loadGltf(path) : loaders[size_t(ending - kSceneEndings.begin())](path);
}

}  // namespace voxray
