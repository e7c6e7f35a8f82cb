#include "base/interrupt.h"

#include <atomic>
#include <csignal>

namespace voxray {
namespace {

// A signal handler can reach nothing but a lock-free static.
std::atomic<bool> requested{false};
static_assert(std::atomic<bool>::is_always_lock_free);

void install(void (*handler)(int), int flags) {
    struct sigaction action = {};
    action.sa_handler = handler;
    action.sa_flags = flags;
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
}

void onSignal(int) {
    requested.store(true);
}

}  // namespace

bool interruptRequested() {
    return requested.load();
}

InterruptScope::InterruptScope() {
    requested.store(false);
    install(onSignal, SA_RESTART | int(SA_RESETHAND));
}

InterruptScope::~InterruptScope() {
    install(SIG_DFL, 0);
    requested.store(false);
}

}  // namespace voxray
