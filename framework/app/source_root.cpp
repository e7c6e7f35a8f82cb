#include "app/source_root.h"

namespace voxray {

const std::filesystem::path& sourceRoot() {
    static const std::filesystem::path root = VOXRAY_SOURCE_DIR;
    return root;
}

}  // namespace voxray
