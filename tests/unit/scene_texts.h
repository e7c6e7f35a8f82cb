#pragma once

#include <fstream>
#include <string>

#include "scene/scene.h"
#include "tests/support/errors.h"
#include "tests/support/temporary_folder.h"

/// For tests of scenes that are written as text.
namespace voxray::test {

inline void writeText(const std::filesystem::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

/// Whether a warning holds both texts.
inline bool warns(const Scene& scene, const std::string& kind, const std::string& name = "") {
    for (const std::string& line : scene.warnings)
        if (line.find(kind) != std::string::npos && line.find(name) != std::string::npos) return true;
    return false;
}

}  // namespace voxray::test
