#pragma once

#include <string>
#include <vector>

#include "experiment/results.h"

namespace voxray {

/// A variant's times, and what tells which of them are alike.
struct TimedVariant {
    const VariantResult* result = nullptr;
    std::string build;     ///< What its build passes depend on; "": its build is not compared.
    bool isAtRest = true;  ///< Whether each of its frames does the same.
};

/// What to say of times that do not agree with each other: equal builds of several variants that differ by
/// more than a fifth, and frames of a variant at rest whose 95th percentile is over 1.5 times their 5th.
/// Something else took the machine's time then. Times below 5 ms are left out: they differ by when the
/// system lets a thread run.
std::vector<std::string> timingOutliers(const std::vector<TimedVariant>& variants);

}  // namespace voxray
