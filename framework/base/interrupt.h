#pragma once

#include <sys/types.h>

#include "base/error.h"

namespace voxray {

/// Thrown by long work that stopped because interruptRequested() became true.
class Interrupted : public Error {
 public:
    Interrupted() : Error("interrupted") {}
};

/// Whether SIGINT or SIGTERM came while an InterruptScope lives. Long work (a reference's paths, rays on the
/// processor, what waits for the device) asks now and then and throws Interrupted.
bool interruptRequested();

/// While it lives, SIGINT and SIGTERM set a flag instead of ending the process; a second signal ends it, and
/// the InterruptedChild with it. Both say so on the standard error. One at a time.
class InterruptScope {
 public:
    InterruptScope();
    ~InterruptScope();
    InterruptScope(const InterruptScope&) = delete;
    InterruptScope& operator=(const InterruptScope&) = delete;
};

/// A process that this one waits for, in a process group of its own (a terminal's Ctrl-C goes to a whole
/// group).
class InterruptedChild {
 public:
    explicit InterruptedChild(pid_t process);
    ~InterruptedChild();
    InterruptedChild(const InterruptedChild&) = delete;
    InterruptedChild& operator=(const InterruptedChild&) = delete;
};

}  // namespace voxray
