#pragma once

#include <filesystem>

namespace voxray {

/// Keeps other processes away from what a file stands for while it lives. The lock is the system's own: it
/// ends with the process, however that ends, and works over network file systems. Its last holder removes the
/// file.
class ProcessLock {
 public:
    /// Many processes may share a lock, while nobody holds it alone.
    enum class Kind { Alone, Shared };

    /// Makes the file where it isn't there. @param what is locked, for messages.
    /// @throws UsageError naming a process that holds the lock, Error where the file can't be locked.
    ProcessLock(std::filesystem::path file, Kind kind, const std::filesystem::path& what);
    ~ProcessLock();
    ProcessLock(const ProcessLock&) = delete;
    ProcessLock& operator=(const ProcessLock&) = delete;

 private:
    std::filesystem::path file_;
    int descriptor_ = -1;
};

}  // namespace voxray
