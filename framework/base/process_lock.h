#pragma once

#include <filesystem>

namespace voxray {

/// A lock between processes, by a lock file. It is a POSIX record lock: released when the process ends, and
/// valid on network file systems. The last holder removes the file.
class ProcessLock {
 public:
    enum class Kind { Exclusive, Shared };
    /// What to do if another process holds the lock.
    enum class IfHeld { Refuse, Wait };

    /// Creates the file if missing. @param what is locked, for messages.
    /// @throws UsageError naming a process that holds the lock (with Wait: Interrupted), Error if the file
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
