#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/process_lock.h"
#include "experiment/prepared_experiment.h"

namespace voxray {

/// How framework/workflow/Snakefile starts the parts of an experiment, and what it asks for them.
struct WorkflowSettings {
    std::string program;                 ///< Text for a shell that starts this program.
    std::vector<std::string> arguments;  ///< Of `run`, for every part: the config and its options.
    std::filesystem::path from;          ///< Where the program is started.
    uint32_t referenceParts = 1;
    bool untimed = false;            ///< Variants may share a machine.
    std::optional<unsigned> cores;   ///< Of this machine; nothing: jobs go to others.
    unsigned threads = 1;            ///< Of a part that shares a machine.
    double pathsPerSecond = 0;       ///< Of one thread, in a reference.
    double secondsPerRun = 0;        ///< Of a variant's graph.
    std::string partition, account;  ///< Of Slurm; empty: its default.
};

/// Where a workflow lies in a results folder: plan.json, Snakefile, done/ with an empty file for each part
/// that is done, logs/.
std::filesystem::path workflowFolder(const std::filesystem::path& results);

/// Claims a results folder for an experiment and writes the workflow of its parts there. Parts whose result
/// isn't there count as not done, whatever an earlier workflow left; the merge is always to be done.
/// @return what keeps other engines away while it lives.
/// @throws UsageError where the folder holds something else or an engine is at work there, Error where it
/// can't be written.
std::unique_ptr<ProcessLock> writeWorkflow(PreparedExperiment& prepared, const std::filesystem::path& results,
                                           const WorkflowSettings& settings);

}  // namespace voxray
