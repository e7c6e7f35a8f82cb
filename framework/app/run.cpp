#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/config_options.h"
#include "app/planning.h"
#include "app/run_summary.h"
#include "base/thread_limit.h"
#include "experiment/runner.h"
#include "experiment/study.h"
#include "passes/common/families.h"

namespace voxray {

void printSummary(const RunSummary& summary, const RunOptions& options) {
    if (options.dryRun) return;
    if (!summary.reportError.empty()) fmt::print(stderr, "voxray: error: no report: {}\n", summary.reportError);
    if (summary.validationMessages > 0)
        fmt::print(stderr, "voxray: error: the Vulkan validation layer has {} message{}\n", summary.validationMessages,
                   summary.validationMessages == 1 ? "" : "s");
    if (summary.interrupted)
        fmt::print(stderr, "voxray: interrupted; finished variants are kept in {}, --resume goes on\n",
                   summary.out.string());
    if (options.quiet || summary.total == 0) return;
    fmt::print("{} of {} variants done{}{}{}\n", summary.ok, summary.total,
               summary.resumed > 0 ? fmt::format(", {} of them by an earlier run", summary.resumed) : "",
               summary.failed > 0 ? fmt::format("; {} failed, results.csv says why", summary.failed) : "",
               summary.missing > 0 ? fmt::format("; {} missing", summary.missing) : "");
    if (options.report && summary.reportError.empty() && summary.ok + summary.failed > 0)
        fmt::print("Report: {}\n", (summary.out / "report.html").string());
}

namespace {

struct RunArguments : ConfigArguments {
    std::vector<std::filesystem::path> configs;
    RunOptions options;
    std::optional<unsigned> threads;
};

/// Runs the configs one after another. @return the exit status.
int run(const RunArguments& arguments) {
    std::optional<ThreadLimit> limit;
    if (arguments.threads) limit.emplace(*arguments.threads);
    Registry registry;
    registerPasses(registry);

    // Check all configs before the first one runs
    std::vector<Study> experiments;
    for (const std::filesystem::path& config : arguments.configs) {
        experiments.push_back(loadStudy(config, arguments.config, arguments.only, registry));
        for (const std::string& profile : profileNames(config))
            makeStudy(loadExperiment(config, {profile, {}}), registry);
    }
    if (!arguments.options.part.empty() && experiments.size() > 1)
        throw UsageError("--part: it is of one config, and {} are given", experiments.size());
    const auto nameOf = [&](size_t i) { return experiments[i].experiment.setup.general.name; };
    for (size_t i = 0; i < experiments.size(); ++i)
        for (size_t j = 0; j < i; ++j)
            if (nameOf(i) == nameOf(j))
                throw UsageError("{} and {} are both named '{}': they would write to one folder",
                                 arguments.configs[j].string(), arguments.configs[i].string(), nameOf(i));

    int status = 0;
    for (size_t i = 0; i < experiments.size(); ++i) {
        RunOptions options = completed(arguments.options, arguments);
        if (experiments.size() > 1 && !options.out.empty()) options.out /= nameOf(i);
        const RunSummary summary = runExperiment(std::move(experiments[i]), options);
        printSummary(summary, options);
        status = std::max(status, summary.exitStatus());
        if (summary.interrupted) break;
    }
    return status;
}

}  // namespace

void addRunCommand(CLI::App& app, int& status) {
    CLI::App* command =
        app.add_subcommand("run", "Render every variant of a config, measure it, write results and report.");
    auto arguments = std::make_shared<RunArguments>();
    RunOptions& options = arguments->options;
    command->add_option("CONFIG", arguments->configs, "Config files.")->required();
    addSweepOptions(*command, *arguments);
    addRunOptions(*command, options,
                  "Results folder; default results/<experiment>. With many configs, each gets a folder in it.");
    command->add_flag("--aovs", options.aovs,
                      "Write what passes offer to look at in frame 0 (position, normals, albedo, depth, "
                      "ids) into aovs.PASS.exr of each variant.");
    command->add_flag_callback(
        "--no-report", [&options] { options.report = false; }, "Write result files alone, no report.html.");
    command
        ->add_option("--part", options.part,
                     "Do one part of the experiment alone, next to others in other processes, "
                     "by its id in 'voxray jobs'.")
        ->type_name("ID")
        ->excludes("--dry-run");
    command
        ->add_flag("--untimed", options.untimed,
                   "Other work runs on this machine meanwhile: a warning says that times tell nothing.")
        ->needs("--part");
    command
        ->add_option("--threads", arguments->threads,
                     "Threads to work on: of loops on the host, Embree and lavapipe. Default: all cores.")
        ->type_name("N")
        ->check(CLI::Range(1u, 1u << 16));
    command->add_flag("--validate", options.validation,
                      "Turn Vulkan's validation layer on: its messages are printed and fail the run (exit status 1). "
                      "Times are then not the method's.");
    command->callback([arguments, &status] { status = run(*arguments); });
}

}  // namespace voxray
