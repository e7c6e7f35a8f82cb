#pragma once

#include "experiment/runner.h"

namespace voxray {

/// Prints the result of a run or a merge.
void printSummary(const RunSummary& summary, const RunOptions& options);

}  // namespace voxray
