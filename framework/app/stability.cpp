#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/commands.h"
#include "app/config_options.h"
#include "app/run_summary.h"
#include "app/source_root.h"
#include "base/error.h"
#include "base/files.h"
#include "base/suggest.h"
#include "experiment/report_process.h"
#include "experiment/runner.h"
#include "passes/register_passes.h"

namespace voxray {

namespace {

struct StabilityArguments : ConfigArguments {
    std::filesystem::path file;
    std::vector<std::string> methods, scenarios;
    RunOptions options;
};

/// A profile of the matrix, without what is not asked for.
struct ProfileRun {
    std::string profile;
    WiredExperiment wired;
};

/// An axis of a config's sweep that names its values.
Value& namedAxis(Value& config, const char* name, const std::string& profile) {
    Value* sweep = config.find("sweep");
    Value* axis = sweep ? sweep->find(name) : nullptr;
    if (!axis || !axis->isMap() || axis->members.empty())
        throw UsageError(config.where, "profile '{}': its sweep needs an axis '{}' that names its values",
                         profile, name);
    return *axis;
}

bool isAsked(const std::vector<std::string>& asked, const std::string& name) {
    return asked.empty() || std::ranges::count(asked, name) > 0;
}

void addNames(std::vector<std::string>& names, const Value& axis) {
    for (const auto& member : axis.members)
        if (std::ranges::count(names, member.key) == 0) names.push_back(member.key);
}

void checkAsked(const std::vector<std::string>& asked, const std::vector<std::string>& names,
                const char* what) {
    for (const std::string& name : asked)
        if (std::ranges::count(names, name) == 0)
            throw UsageError("no {} '{}'{}", what, name, didYouMean(name, names));
}

/// The profiles that have any scene that is asked for, with these scenes and methods. A profile's first scene
/// is what others are compared with: it stays where one of them does.
/// @throws UsageError for a scene or method that no profile has, and where a profile can't be run.
std::vector<ProfileRun> profileRuns(const StabilityArguments& arguments, const Registry& registry) {
    std::vector<std::string> profiles{arguments.config.profile};
    if (profiles[0].empty()) profiles = profileNames(arguments.file);
    std::vector<std::string> scenes, methods;
    struct Choice {
        std::string profile;
        Experiment whole, asked;
    };
    std::vector<Choice> experiments;
    for (const std::string& profile : profiles) {
        const Experiment whole = loadExperiment(arguments.file, {profile, arguments.config.assignments});
        Value config = whole.config;
        Value& sceneAxis = namedAxis(config, "scene", profile);
        Value& methodAxis = namedAxis(config, "method", profile);
        addNames(scenes, sceneAxis);
        addNames(methods, methodAxis);
        const std::string first = sceneAxis.members[0].key;
        const auto isWanted = [&](const auto& member) { return isAsked(arguments.scenarios, member.key); };
        if (std::ranges::none_of(sceneAxis.members, isWanted)) continue;
        std::erase_if(sceneAxis.members,
                      [&](const auto& member) { return member.key != first && !isWanted(member); });
        std::erase_if(methodAxis.members,
                      [&](const auto& member) { return !isAsked(arguments.methods, member.key); });
        if (methodAxis.members.empty()) continue;
        Experiment asked = readExperiment(std::move(config));
        asked.file = arguments.file;
        experiments.push_back({profile, whole, std::move(asked)});
    }
    checkAsked(arguments.methods, methods, "method");
    checkAsked(arguments.scenarios, scenes, "scenario");
    if (experiments.empty())
        throw UsageError("{}: none of its profiles has that scene with that method", arguments.file.string());
    std::vector<ProfileRun> runs;
    for (auto& [profile, whole, asked] : experiments) {
        const WiredExperiment all = wireExperiment(std::move(whole), registry);
        runs.push_back({profile, wireExperiment(std::move(asked), registry)});
        for (const auto& [id, count] : variantsWithout(runs.back().wired))
            if (runsSomewhere(all, id)) runs.back().wired.deselected.push_back(id);
    }
    return runs;
}

/// Runs the profiles one after the other, then makes the tables. @return the exit status.
int stability(const StabilityArguments& given) {
    StabilityArguments arguments = given;
    if (arguments.file.empty()) arguments.file = sourceRoot() / "configs/stability/matrix.yaml";
    if (arguments.options.out.empty()) arguments.options.out = std::filesystem::path("results") / "stability";
    Registry registry;
    registerPasses(registry);

    int status = 0;
    for (ProfileRun& run : profileRuns(arguments, registry)) {
        RunOptions options = arguments.options;
        options.scenes = arguments.scenes;
        options.sourceRoot = sourceRoot();
        options.report = false;
        options.out /= run.profile;
        if (!options.quiet) fmt::print("Profile {}\n", run.profile);
        const RunSummary summary = runExperiment(std::move(run.wired), options, registry);
        printSummary(summary, options);
        status = std::max(status, summary.exitStatus());
        if (summary.interrupted) return status;
    }
    if (arguments.options.dryRun) return status;

    const std::filesystem::path& out = arguments.options.out;
    std::filesystem::path limits = arguments.file;
    limits.replace_extension(".csv");
    const ScriptEnd end =
        runReportScript(sourceRoot(), "make_stability.py", {out.string(), limits.string()}, OnInterrupt::End);
    if (end.status == 2) throw UsageError("{}", end.lastLine);
    if (end.status != 0) throw Error("{}", end.lastLine);
    if (!arguments.options.quiet)
        fmt::print("{}{}\nPage: {}\n", readTextFile(out / "stability.md"), end.lastLine,
                   (out / "stability.html").string());
    return status;
}

}  // namespace

void addStabilityCommand(CLI::App& app, int& status) {
    auto arguments = std::make_shared<StabilityArguments>();
    CLI::App* command = app.add_subcommand(
        "stability",
        "Show where methods fail: run each in scenes that provoke one failure each (leaks, lost energy, "
        "flicker ...), and hold every result against its limit.");
    command->add_option("METHOD", arguments->methods, "Methods of the matrix; all by default.");
    command
        ->add_option("--scenario", arguments->scenarios,
                     "Run this scene of the matrix, and the first of its profile. May be given many times.")
        ->type_name("NAME")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command
        ->add_option("--config", arguments->file,
                     "The matrix, its limits next to it in a .csv of the same name; default "
                     "configs/stability/matrix.yaml.")
        ->type_name("CONFIG");
    addConfigOptions(*command, *arguments);
    addRunOptions(
        *command, arguments->options,
        "Folder of the tables and of a results folder for each profile; default results/stability.");
    command->callback([arguments, &status] { status = stability(*arguments); });
}

}  // namespace voxray
