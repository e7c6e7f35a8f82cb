#pragma once

#include <filesystem>
#include <string>

#include "experiment/checks/view.h"
#include "experiment/study.h"

namespace voxray {

struct RunOptions {
    std::filesystem::path out;     ///< Empty: results/<experiment> below the current folder.
    std::filesystem::path scenes;  ///< Value of --scenes; searched first.
    std::string deviceName;        ///< Empty: the best.
    std::string tracer;            ///< Name of a backend that replaces the config's. Empty: the config's.
    bool resume = false;           ///< Reuse results of an earlier run of the same experiment, and wait for
                                   ///< another process that does the same part.
    bool dryRun = false;           ///< Print variants, passes and known memory; render nothing.
    bool quiet = false;
    bool validation = false;  ///< Enable Vulkan's validation layer, whose messages fail the run.
    bool aovs = false;        ///< Write AOVs of frame 0 with each variant's images.
    bool report = true;       ///< Make report.html at the end.
    std::string part;         ///< Do only this part of the experiment (parts.h); empty: all of them.
    bool untimed = false;     ///< Other parts run on the same machine: a warning says that times are unreliable.
    std::filesystem::path sourceRoot;
    Preview previewTracer;  ///< Path traces previews on the host for checks of each view; empty: no such checks.
};

struct RunSummary {
    size_t total = 0;  ///< Variants of the experiment; 0 if only a part of it was done.
    size_t ok = 0;     ///< Including resumed ones.
    size_t failed = 0;
    size_t missing = 0;             ///< Only for a merge: variants in none of its folders.
    size_t resumed = 0;             ///< Variants that an earlier run finished.
    size_t validationMessages = 0;  ///< Messages of Vulkan's validation layer, which were printed.
    bool interrupted = false;
    std::string reportError;  ///< Why there is no report.
    std::filesystem::path out;

    /// 0: done. 1: a variant or the report failed, or there are validation messages. 130: interrupted.
    int exitStatus() const {
        const bool isWhole = failed == 0 && missing == 0 && validationMessages == 0 && reportError.empty();
        return interrupted ? 130 : isWhole ? 0 : 1;
    }
};

/// Renders every variant of an experiment, measures it and writes the results folder
/// (docs/reading-a-report.md); or does a single part of that, possibly while other processes do other parts.
/// A variant that throws is recorded as failed, and the run continues. Images and metrics are the same for
/// the same config and seed.
/// @throws UsageError for mistakes that are found before anything runs (e.g. missing scenes, devices or
/// tracers); Error if the results folder can't be written. Finished variants are kept.
RunSummary runExperiment(Study study, const RunOptions& options);
/// The same after makeStudy(). @throws UsageError also for graphs and sweeps.
RunSummary runExperiment(const Experiment& experiment, const RunOptions& options, const Registry& registry);

}  // namespace voxray
