#include "tests/support/places.h"

#include <cstdlib>

namespace voxray::test {

const std::filesystem::path& sourceRoot() {
    static const std::filesystem::path root = VOXRAY_SOURCE_DIR;
    return root;
}

const std::filesystem::path& shaderCache() {
    static const std::filesystem::path folder = VOXRAY_TEST_CACHE;
    return folder;
}

std::filesystem::path scenesFolder() {
    const char* folder = std::getenv("VOXRAY_SCENES");
    return folder && *folder ? std::filesystem::path(folder) : sourceRoot() / ".." / "shared" / "scenes";
}

}  // namespace voxray::test
