#include <fmt/ranges.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/config_options.h"
#include "app/source_root.h"
#include "base/error.h"
#include "base/files.h"
#include "base/suggest.h"
#include "config/yaml.h"
#include "experiment/counterparts.h"
#include "experiment/report_process.h"
#include "experiment/runner.h"
#include "passes/common/families.h"
#include "passes/path_trace/preview.h"

namespace voxray {

namespace {

struct ExplainArguments : ConfigArguments {
    std::filesystem::path file;
    std::string variant;
    RunOptions options;
};

/// The variant of that name, or the only one whose name ends so after a '-': `lookup` of `indirect-lookup`.
const Variant& chosen(const Study& wired, const std::string& name) {
    std::vector<std::string> names, endings;
    const Variant* ending = nullptr;
    for (const Variant& variant : wired.variants) {
        if (variant.name == name || (name.empty() && wired.variants.size() == 1)) return variant;
        names.push_back(variant.name);
        if (name.empty() || !variant.name.ends_with("-" + name)) continue;
        ending = &variant;
        endings.push_back(variant.name);
    }
    if (endings.size() == 1) return *ending;
    if (endings.size() > 1)
        throw UsageError("--variant: '{}' ends the names of {} variants: {}", name, endings.size(),
                         fmt::join(endings, ", "));
    if (!name.empty()) throw UsageError("--variant: no variant '{}'{}", name, didYouMean(name, names));
    throw UsageError(
        "the config has {} variants, and explain takes one: choose it with --variant, as in --variant {}",
        names.size(), names.back());
}

/// @return the exit status.
int explain(const ExplainArguments& arguments) {
    Registry registry;
    registerPasses(registry);
    const Study wired = wireExperiment(loadExperiment(arguments.file, arguments.config), registry);
    const SwapPlan plan = planSwaps(readYaml(sourceRoot() / "passes" / "counterparts.yaml"), wired,
                                    chosen(wired, arguments.variant), registry);

    RunOptions options = arguments.options;
    options.scenes = arguments.scenes;
    options.sourceRoot = sourceRoot();
    options.preview = pathTracedPreview;
    const RunSummary summary = runExperiment(plan.experiment, options, registry);
    if (options.dryRun) return summary.exitStatus();
    if (summary.interrupted)
        fmt::print(stderr, "voxray: interrupted; finished variants are kept in {}, --resume goes on\n",
                   summary.out.string());
    if (summary.failed > 0)
        fmt::print(stderr, "voxray: error: {} of {} variants failed, {} says why\n", summary.failed,
                   summary.total, (summary.out / "results.csv").string());
    if (summary.exitStatus() != 0) return summary.exitStatus();

    writeFileAtomically(summary.out / "explain.json", plan.json());
    const ScriptEnd end =
        runReportScript(sourceRoot(), "make_explain.py", {summary.out.string()}, OnInterrupt::End);
    if (end.status != 0) throw Error("{}", end.lastLine);
    fmt::print("{}\nPage: {}\n", end.lastLine, (summary.out / "explain.html").string());
    return 0;
}

}  // namespace

void addExplainCommand(CLI::App& app, int& status) {
    auto arguments = std::make_shared<ExplainArguments>();
    CLI::App* command = app.add_subcommand(
        "explain",
        "Say where a config's error comes from: render it with each stage swapped for an exact counterpart, "
        "and give each its part of the error of the indirect light.");
    command->add_option("CONFIG", arguments->file, "Config file.")->required();
    command
        ->add_option(
            "--variant", arguments->variant,
            "Which variant of the config's sweep is explained, by its name in results.csv or the end of "
            "it, as in lookup for indirect-lookup.")
        ->type_name("NAME");
    addConfigOptions(*command, *arguments);
    addRunOptions(*command, arguments->options, "Results folder; default results/explain_<experiment>.");
    command->callback([arguments, &status] { status = explain(*arguments); });
}

}  // namespace voxray
