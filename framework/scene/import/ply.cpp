#include "scene/import/ply.h"

#include "base/error.h"

namespace voxray {

Mesh readPly(const std::filesystem::path& path, MemoryBudget&) {
    throw Error("{}: PLY files are not read yet; convert it to OBJ", path.string());
}

}  // namespace voxray
