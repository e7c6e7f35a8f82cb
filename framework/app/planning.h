#pragma once

#include <filesystem>
#include <functional>

#include "app/config_options.h"
#include "experiment/prepared_experiment.h"

namespace voxray {

/// Reads a config and wires it. Passes that values which --only leaves out would run are no mistake.
Study loadStudy(const std::filesystem::path& file, const ConfigOptions& options, const Registry& registry);

/// Plans the experiment of a config as a run would, prints what may mislead, and hands it over.
/// @throws UsageError as loadExperiment(), makeStudy() and runExperiment().
void planExperiment(const std::filesystem::path& file, const ConfigArguments& arguments, RunOptions options,
                    const std::function<void(PreparedExperiment&)>& use);

}  // namespace voxray
