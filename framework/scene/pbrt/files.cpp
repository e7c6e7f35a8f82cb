#include "scene/pbrt/files.h"

#include "base/suggest.h"

namespace voxray::pbrt {

std::filesystem::path findFile(const std::filesystem::path& folder, const std::string& name,
                               const TextLocation& where) {
    const std::filesystem::path path = folder / name;
    std::error_code code;
    if (!std::filesystem::is_regular_file(path, code))
        throw Error(where, "there is no file {}{}", path.string().substr(0, 300), didYouMeanFile(path));
    return path;
}

}  // namespace voxray::pbrt
