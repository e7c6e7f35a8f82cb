#include "base/interrupt.h"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <string_view>

namespace voxray {
namespace {

// Signal handlers may only access lock-free statics.
std::atomic<bool> requested{false}, cancelled{false};
std::atomic<pid_t> child{0};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<pid_t>::is_always_lock_free);

void install(void (*handler)(int), int flags) {
    struct sigaction action = {};
    action.sa_handler = handler;
    action.sa_flags = flags;
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
}

/// Async-signal-safe. An unterminated progress line may precede the text.
void writeToStderr(std::string_view line) {
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, line.data(), line.size());
}

void onSignal(int number) {
    const int error = errno;
    if (!requested.exchange(true)) {
        writeToStderr("\nvoxray: stopping; a second Ctrl-C ends the program at once\n");
        errno = error;
        return;
    }
    writeToStderr("\nvoxray: ended\n");
    if (const pid_t process = child.load(); process > 0) ::kill(process, SIGINT);
    install(SIG_DFL, 0);
    ::raise(number);
}

}  // namespace

bool interruptRequested() {
    return requested.load() || cancelled.load();
}

void requestCancel() {
    cancelled.store(true);
}

void clearCancel() {
    cancelled.store(false);
}

InterruptScope::InterruptScope() {
    requested.store(false);
    install(onSignal, SA_RESTART);
}

InterruptScope::~InterruptScope() {
    install(SIG_DFL, 0);
    requested.store(false);
}

InterruptedChild::InterruptedChild(pid_t process) {
    child.store(process);
}

InterruptedChild::~InterruptedChild() {
    child.store(0);
}

}  // namespace voxray
