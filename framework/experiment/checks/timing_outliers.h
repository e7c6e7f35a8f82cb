#pragma once

#include <string>
#include <vector>

#include "experiment/results.h"

namespace voxray {

/// The times of a variant, and which of them should be equal.
struct TimedVariant {
    const VariantResult* result = nullptr;
    std::string build;     ///< Everything its build passes depend on; "": its build is not compared.
    bool isSteady = true;  ///< Whether all its frames do the same work.
};

/// Warns of times that were disturbed by other processes: equal builds of several variants that differ by
/// more than a fifth, and steady frames of a variant whose 95th percentile is over 1.5 times their 5th. Times
/// below 5 ms are skipped, since they depend on the scheduling of threads.
std::vector<std::string> timingOutliers(const std::vector<TimedVariant>& variants);

}  // namespace voxray
