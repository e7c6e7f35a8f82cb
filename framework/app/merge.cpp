#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <vector>

#include "app/commands.h"
#include "app/run_summary.h"
#include "app/source_root.h"
#include "base/interrupt.h"
#include "experiment/merge.h"

namespace voxray {

namespace {

struct MergeArguments {
    std::vector<std::filesystem::path> folders;
    RunOptions options;
};

/// @return the exit status.
int merge(MergeArguments arguments) {
    const InterruptScope interruptScope;
    RunOptions& options = arguments.options;
    options.sourceRoot = sourceRoot();
    RunSummary summary;
    try {
        summary = mergeResults(arguments.folders, options.out, options);
    } catch (const Interrupted&) {
        summary.interrupted = true;
        summary.out = options.out;
    }
    printSummary(summary, options);
    return summary.exitStatus();
}

}  // namespace

void addMergeCommand(CLI::App& app, int& status) {
    auto arguments = std::make_shared<MergeArguments>();
    RunOptions& options = arguments->options;
    CLI::App* command = app.add_subcommand(
        "merge",
        "Put results of one experiment that lie in many folders together, such as its parts, and make the report. "
        "Folders that differ in config, scene or version are refused.");
    command->add_option("DIR", arguments->folders, "Results folders.")->required();
    command->add_option("--out", options.out, "Folder of all results: a new one, or one of the others.")
        ->required()
        ->type_name("DIR");
    command->add_flag_callback(
        "--no-report", [&options] { options.report = false; }, "Write result files alone, no report.html.");
    command->add_flag("--wait", options.resume,
                      "Wait for another process that is writing into --out, in place of an error.");
    command->add_flag("--quiet", options.quiet, "Print nothing but warnings and errors.");
    command->callback([arguments, &status] { status = merge(*arguments); });
}

}  // namespace voxray
