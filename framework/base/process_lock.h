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
    /// What to do where another process holds the lock.
    enum class IfHeld { Refuse, Wait };

    /// Makes the file where it isn't there. @param what is locked, for messages.
    /// @throws UsageError naming a process that holds the lock (to wait: Interrupted), Error where the file
    /// can't be locked.
    ProcessLock(std::filesystem::path file, Kind kind, const std::filesystem::path& what,
                IfHeld ifHeld = IfHeld::Refuse);
    ~ProcessLock();
    ProcessLock(const ProcessLock&) = delete;
    ProcessLock& operator=(const ProcessLock&) = delete;

 private:
    std::filesystem::path file_;
    int descriptor_ = -1;
};

}  // namespace voxray
