#include "base/thread_limit.h"

#include <tbb/global_control.h>

#include <cstdlib>
#include <string>

namespace voxray {

struct ThreadLimit::Control {
    tbb::global_control control;
};

ThreadLimit::ThreadLimit(unsigned threads)
    : control_(new Control{{tbb::global_control::max_allowed_parallelism, threads}}) {
    ::setenv("LP_NUM_THREADS", std::to_string(threads).c_str(), 1);
}

ThreadLimit::~ThreadLimit() = default;

unsigned workerThreads() {
    return unsigned(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

}  // namespace voxray
