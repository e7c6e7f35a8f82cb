#pragma once

#include <sys/types.h>

#include "base/error.h"

namespace voxray {

/// Thrown by long work when interruptRequested().
class Interrupted : public Error {
 public:
    Interrupted() : Error("interrupted") {}
};

/// Whether SIGINT or SIGTERM arrived during an InterruptScope, or requestCancel() was called. Long work (path tracing
/// of references, rays on the CPU, waits for the device) polls it and throws Interrupted.
bool interruptRequested();

/// Makes interruptRequested() true until clearCancel(), for a thread that ends the long work of another one.
void requestCancel();
void clearCancel();

/// In this scope SIGINT and SIGTERM set a flag instead of ending the process; a second signal ends it and the
/// InterruptedChild. Both print a message to stderr. At most one instance.
class InterruptScope {
 public:
    InterruptScope();
    ~InterruptScope();
    InterruptScope(const InterruptScope&) = delete;
    InterruptScope& operator=(const InterruptScope&) = delete;
};

/// A child process in its own process group, which a terminal's Ctrl-C doesn't reach.
class InterruptedChild {
 public:
    explicit InterruptedChild(pid_t process);
    ~InterruptedChild();
    InterruptedChild(const InterruptedChild&) = delete;
    InterruptedChild& operator=(const InterruptedChild&) = delete;
};

}  // namespace voxray
