#pragma once

#include "experiment/runner.h"

namespace voxray {

/// What a run or a merge says at its end.
void printSummary(const RunSummary& summary, const RunOptions& options);

}  // namespace voxray
