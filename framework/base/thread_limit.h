#pragma once

#include <memory>

namespace voxray {

/// While it lives, this process works on so many threads: parallel loops and Embree; devices of Mesa's
/// software driver lavapipe that are opened from now on as well. Results don't depend on it.
class ThreadLimit {
 public:
    /// @param threads at least 1.
    explicit ThreadLimit(unsigned threads);
    ~ThreadLimit();
    ThreadLimit(const ThreadLimit&) = delete;
    ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
    struct Control;
    std::unique_ptr<Control> control_;
};

/// How many threads parallel loops work on: the limit, else one for each core that this process may use.
unsigned workerThreads();

}  // namespace voxray
