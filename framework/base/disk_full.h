#pragma once

#include <filesystem>

#include "base/error.h"

namespace voxray {

/// A file can't be written because its disk is full.
class DiskFull : public Error {
 public:
    /// @param folder that the file was to lie in.
    explicit DiskFull(const std::filesystem::path& folder)
        : Error("disk full: {}", folder.empty() ? "." : folder.string()) {}
};

}  // namespace voxray
