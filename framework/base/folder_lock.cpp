#include "base/folder_lock.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/error.h"

namespace voxray {
namespace {

struct flock wholeFile() {
    struct flock lock {};
    lock.l_type = F_WRLCK;
    lock.l_whence = SEEK_SET;
    return lock;
}

// Whether the open file is still the one of that name: its owner removes it at the end.
bool isCurrent(int descriptor, const std::filesystem::path& file) {
    struct stat open {
    }, named{};
    return ::fstat(descriptor, &open) == 0 && ::stat(file.c_str(), &named) == 0 &&
           open.st_ino == named.st_ino && open.st_dev == named.st_dev;
}

}  // namespace

FolderLock::FolderLock(const std::filesystem::path& folder) : file_(folder / kFileName) {
    constexpr int kTries = 100;
    for (int attempt = 0; attempt < kTries; ++attempt) {
        descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
        if (descriptor_ < 0) throw Error("{}: {}", file_.string(), std::strerror(errno));
        struct flock lock = wholeFile();
        const bool isLocked = ::fcntl(descriptor_, F_SETLK, &lock) == 0;
        const int reason = errno;
        if (isLocked && isCurrent(descriptor_, file_)) return;

        // Who has it; nobody any more where it was freed in between
        lock = wholeFile();
        const bool isHeld = !isLocked && (reason == EACCES || reason == EAGAIN);
        if (isHeld) ::fcntl(descriptor_, F_GETLK, &lock);
        ::close(descriptor_);
        if (isHeld && lock.l_type != F_UNLCK)
            throw UsageError(
                "{}: process {} is writing results there; wait until it ends or choose another "
                "folder with --out",
                folder.string(), lock.l_pid);
        if (!isLocked && !isHeld)
            throw Error("{}: cannot be locked: {}", file_.string(), std::strerror(reason));
    }
    throw Error("{}: cannot be locked: other processes take it again and again", file_.string());
}

FolderLock::~FolderLock() {
    ::unlink(file_.c_str());
    ::close(descriptor_);
}

}  // namespace voxray
