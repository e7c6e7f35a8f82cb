#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstddef>

namespace voxray {

/// Calls body(begin, end) over disjoint ranges that cover [0, count), on all cores.
/// Ranges hold at least `grain` items. Results must not depend on the partition.
template <typename Body>
void parallelRanges(size_t count, size_t grain, const Body& body) {
    tbb::parallel_for(tbb::blocked_range<size_t>(0, count, grain),
                      [&](const tbb::blocked_range<size_t>& r) { body(r.begin(), r.end()); });
}

}  // namespace voxray
