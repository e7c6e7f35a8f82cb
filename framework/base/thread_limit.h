#pragma once

#include <memory>

namespace voxray {

/// Limits the threads of parallel loops, of Embree, and of lavapipe devices (Mesa's software driver) that are
/// opened during its lifetime. Results don't depend on it.
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

/// Threads of parallel loops: the limit, else one per core that this process may use.
unsigned workerThreads();

}  // namespace voxray
