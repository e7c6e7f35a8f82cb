#include "base/error.h"
#include "scene/load.h"

namespace voxray {

std::shared_ptr<const Scene> loadPbrt(const std::filesystem::path& path) {
    throw Error("{}: pbrt scenes are not read yet; export it as .glb", path.string());
}

}  // namespace voxray
