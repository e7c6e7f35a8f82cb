#pragma once

#include <filesystem>
#include <functional>

#include "app/config_options.h"
#include "experiment/prepared_experiment.h"

namespace voxray {

/// Reads a config and makes its study. Passes that run only in variants excluded by --only are recorded, so
/// that they are not reported as unused. @param only choices of selectSweepValues().
Study loadStudy(const std::filesystem::path& file, const ConfigOptions& options, const std::vector<std::string>& only,
                const Registry& registry);

/// Options as given, with what no option says: scene folders, the source root and the tracer of previews.
RunOptions completed(RunOptions options, const ConfigArguments& arguments);

/// Plans the experiment of a config as a run does, prints warnings, and calls `use`.
/// @throws UsageError as loadExperiment(), makeStudy() and runExperiment().
void planExperiment(const std::filesystem::path& file, const ConfigArguments& arguments, const RunOptions& options,
                    const std::function<void(PreparedExperiment&)>& use);

}  // namespace voxray
