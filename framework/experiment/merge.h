#pragma once

#include <filesystem>
#include <vector>

#include "experiment/runner.h"

namespace voxray {

/// Puts results of one experiment that lie in many folders, of parts or of runs that were cut short, together
/// and makes the report. Variants and references that are not in `out` are copied there.
/// @param out a new folder, or one of `folders`. @param options quiet, report, sourceRoot, and resume: wait
/// for another process that writes into `out`.
/// @return which variants are `ok`, which `failed`, as their parts or those of their reference recorded, and
/// how many are `missing`. Warns of what makes them hard to compare.
/// @throws UsageError for folders that are not of one experiment (config, version, scenes), naming the first
/// difference; for a variant that two of them hold; for other results in `out`.
RunSummary mergeResults(const std::vector<std::filesystem::path>& folders, const std::filesystem::path& out,
                        const RunOptions& options);

}  // namespace voxray
