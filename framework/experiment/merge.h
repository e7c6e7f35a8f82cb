#pragma once

#include <filesystem>
#include <vector>

#include "experiment/runner.h"

namespace voxray {

/// Merges results of one experiment in several folders, which may be those of parts or of interrupted runs,
/// and makes the report. Variants and references that are not in `out` are copied there.
/// @param out a new folder, or one of `folders`. @param options quiet, report, sourceRoot, and resume: wait
/// for another process that writes into `out`.
/// @return the numbers of variants that are `ok`, that `failed` according to the records of parts, and that
/// are `missing`. Warns if variants ran on different devices.
/// @throws UsageError for folders of different experiments (config, version, scenes), with the first
/// difference; for a variant that is in two of them; for other results in `out`.
RunSummary mergeResults(const std::vector<std::filesystem::path>& folders, const std::filesystem::path& out,
                        const RunOptions& options);

}  // namespace voxray
