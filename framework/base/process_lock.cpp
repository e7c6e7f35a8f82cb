#include "base/process_lock.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>
#include <utility>

#include "base/error.h"
#include "base/interrupt.h"

namespace voxray {
namespace {

struct flock wholeFile(ProcessLock::Kind kind) {
    struct flock lock {};
    lock.l_type = kind == ProcessLock::Kind::Exclusive ? F_WRLCK : F_RDLCK;
    lock.l_whence = SEEK_SET;
    return lock;
}

// Whether the open file still has that name: its last holder removes it.
bool isCurrent(int descriptor, const std::filesystem::path& file) {
    struct stat open {
    }, named{};
    return ::fstat(descriptor, &open) == 0 && ::stat(file.c_str(), &named) == 0 && open.st_ino == named.st_ino &&
           open.st_dev == named.st_dev;
}

}  // namespace

ProcessLock::ProcessLock(std::filesystem::path file, Kind kind, const std::filesystem::path& what, IfHeld ifHeld)
    : file_(std::move(file)) {
    constexpr int kTries = 100;
    constexpr std::chrono::milliseconds kPause(100);
    bool isAnnounced = false;
    for (int attempt = 0; attempt < kTries; ++attempt) {
        descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
        if (descriptor_ < 0) throw Error("{}: {}", file_.string(), std::strerror(errno));
        struct flock lock = wholeFile(kind);
        const bool isLocked = ::fcntl(descriptor_, F_SETLK, &lock) == 0;
        const int reason = errno;
        if (isLocked && isCurrent(descriptor_, file_)) return;

        // The holder; none if it was released in between
        lock = wholeFile(kind);
        const bool isHeld = !isLocked && (reason == EACCES || reason == EAGAIN);
        if (isHeld) ::fcntl(descriptor_, F_GETLK, &lock);
        ::close(descriptor_);
        if (isHeld && ifHeld == IfHeld::Wait) {
            if (interruptRequested()) throw Interrupted();
            if (!std::exchange(isAnnounced, true))
                fmt::print(stderr, "voxray: {}: waiting for process {}, which is writing there\n", what.string(),
                           lock.l_pid);
            std::this_thread::sleep_for(kPause);
            attempt = -1;  // The limit is for files that are removed and created again.
        } else if (isHeld && lock.l_type != F_UNLCK) {
            throw UsageError(
                "{}: process {} is writing results there; wait until it ends or choose another folder with --out",
                what.string(), lock.l_pid);
        }
        if (!isLocked && !isHeld) throw Error("{}: cannot be locked: {}", file_.string(), std::strerror(reason));
    }
    throw Error("{}: cannot be locked: other processes take it again and again", file_.string());
}

ProcessLock::~ProcessLock() {
    // The last holder can lock it exclusively
    struct flock lock = wholeFile(Kind::Exclusive);
    if (::fcntl(descriptor_, F_SETLK, &lock) == 0) ::unlink(file_.c_str());
    ::close(descriptor_);
}

}  // namespace voxray
