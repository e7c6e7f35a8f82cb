#pragma once

#include <filesystem>
#include <string>

#include "experiment/checks/view.h"
#include "experiment/study.h"

namespace voxray {

struct RunOptions {
    std::filesystem::path out;     ///< Empty: results/<experiment> below the current folder.
    std::filesystem::path scenes;  ///< Of --scenes; searched first.
    std::string deviceName;        ///< Empty: the best.
    std::string tracer;            ///< Name of a backend; replaces the config's. Empty: the config's.
    bool resume = false;           ///< Keep what an earlier run of the same experiment finished, and wait for
                                   ///< another process that is at the same part.
    bool dryRun = false;           ///< Print variants, passes and known memory; render nothing.
    bool quiet = false;
    bool validation = false;  ///< Vulkan validation layer; its messages fail the run.
    bool aovs = false;        ///< Write AOVs of frame 0 next to each variant's images.
    bool report = true;       ///< Make report.html at the end.
    std::string part;         ///< Do this part of the experiment alone (parts.h); empty: all of them.
    bool untimed = false;     ///< Of a part: it shares its machine with others, and times are warned of.
    std::filesystem::path sourceRoot;
    Preview preview;  ///< Looks at each view before anything is rendered; empty: views are not looked at.
};

struct RunSummary {
    size_t total = 0;  ///< Variants of the experiment; 0 where one part of it was done.
    size_t ok = 0;     ///< Resumed ones included.
    size_t failed = 0;
    size_t missing = 0;             ///< Of a merge: in none of its folders.
    size_t resumed = 0;             ///< Taken over from an earlier run.
    size_t validationMessages = 0;  ///< Of the Vulkan validation layer; all were printed.
    bool interrupted = false;
    std::string reportError;  ///< Why there is no report.
    std::filesystem::path out;

    /// 0 done, 1 some variant or the report failed or the validation layer complained, 130 interrupted.
    int exitStatus() const {
        const bool isWhole = failed == 0 && missing == 0 && validationMessages == 0 && reportError.empty();
        return interrupted ? 130 : isWhole ? 0 : 1;
    }
};

/// Renders every variant of an experiment, measures it and writes the results folder
/// (docs/reading-a-report.md); or does one part of that, next to others in other processes. A variant that
/// throws is recorded as failed and the others go on. Same config and seed: same images and metrics.
/// @throws UsageError for what can be seen to be wrong before anything runs (missing scenes, a device or
/// tracer that isn't there); Error where the results folder can't be written: finished variants are kept.
RunSummary runExperiment(Study study, const RunOptions& options);
/// The same, wired first. @throws UsageError also for graphs and sweeps.
RunSummary runExperiment(const Experiment& experiment, const RunOptions& options, const Registry& registry);

}  // namespace voxray
