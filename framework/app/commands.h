#pragma once

#include <CLI/CLI.hpp>

/// The commands of `voxray`. Each function adds a command. Its callback sets the exit status (0: done, 1:
/// something failed, 2: invalid usage or config, 130: interrupted) and may throw Error and UsageError.
namespace voxray {

void addRunCommand(CLI::App& app, int& status);
void addValidateCommand(CLI::App& app, int& status);
void addSchemaCommand(CLI::App& app, int& status);
void addSceneCommand(CLI::App& app, int& status);
void addExportSceneCommand(CLI::App& app, int& status);
void addCompareCommand(CLI::App& app, int& status);
void addJobsCommand(CLI::App& app, int& status);
void addMergeCommand(CLI::App& app, int& status);
void addLookCommand(CLI::App& app, int& status);
void addSessionCommand(CLI::App& app, int& status);
void addSweepCommand(CLI::App& app, int& status);
void addParetoCommand(CLI::App& app, int& status);
void addExplainCommand(CLI::App& app, int& status);
void addStabilityCommand(CLI::App& app, int& status);
void addTuneCommand(CLI::App& app, int& status);
void addPackCommand(CLI::App& app, int& status);
void addVerifyCommand(CLI::App& app, int& status);
void addPlanCommand(CLI::App& app, int& status);
void addPassesCommand(CLI::App& app, int& status);
void addDevicesCommand(CLI::App& app, int& status);
void addDoctorCommand(CLI::App& app, int& status);

}  // namespace voxray
