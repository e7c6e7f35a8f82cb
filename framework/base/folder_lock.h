#pragma once

#include <filesystem>

namespace voxray {

/// Keeps other processes from writing into a folder while it lives. The lock is the system's own, on a file
/// `.lock` in the folder: it ends with the process, however that ends, and works over network file systems.
class FolderLock {
 public:
    static constexpr const char* kFileName = ".lock";

    /// @throws UsageError naming the process that holds the folder, Error where it can't be locked.
    explicit FolderLock(const std::filesystem::path& folder);
    ~FolderLock();
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;

 private:
    std::filesystem::path file_;
    int descriptor_ = -1;
};

}  // namespace voxray
