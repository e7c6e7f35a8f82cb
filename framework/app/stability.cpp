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
#include "config/overrides.h"
#include "config/yaml.h"
#include "experiment/report_process.h"
#include "experiment/runner.h"
#include "passes/common/families.h"
#include "passes/path_trace/preview.h"

namespace voxray {

namespace {

struct StabilityArguments : ConfigArguments {
    std::filesystem::path file;
    std::vector<std::string> methods, scenarios;
    bool remedies = false;
    Value changes = Value::map();  ///< Of a remedy: METHODS -> PATH -> value, made after profile and --set.
    RunOptions options;
};

/// A profile of the matrix, without what is not asked for.
struct ProfileRun {
    std::string profile;
    Study wired;
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

/// Sets a parameter in a method's chain of passes. @return whether a pass of the chain has the path's id.
bool changeChain(Value& chain, const std::string& path, const Value& value) {
    const size_t dot = path.find('.');
    const std::string id = path.substr(0, dot);
    const auto change = [&](Value& entry) {
        if ((entry.isScalar() ? entry.scalar : passId(entry)) != id || dot == std::string::npos) return false;
        if (entry.isScalar()) {
            Value map = Value::map();
            map.where = entry.where;
            map.set("pass", entry);
            entry = std::move(map);
        }
        entry.set(path.substr(dot + 1), value);
        return true;
    };
    if (!chain.isList()) return change(chain);
    return std::ranges::count_if(chain.items, change) > 0;
}

constexpr const char* kEveryMethod = "every method";

/// Whether an entry of a remedy, the beginning of methods' names, means this method.
bool isMeant(const std::string& beginning, const std::string& method) {
    return beginning == kEveryMethod || method.starts_with(beginning);
}

/// Makes what a remedy changes for the methods that are asked for: in their chains, where a pass there has
/// the path's id, else in the config.
void applyRemedy(Value& config, const Value& changes, const std::vector<std::string>& methods,
                 const std::string& profile) {
    for (const auto& [beginning, own] : changes.members) {
        const auto isAskedFor = [&](const std::string& method) { return isMeant(beginning, method); };
        if (std::ranges::none_of(methods, isAskedFor)) continue;
        for (const auto& [path, value] : own.members) {
            bool isInChain = false;
            for (auto& [method, chain] : namedAxis(config, "method", profile).members)
                if (isMeant(beginning, method) && changeChain(chain, path, value)) isInChain = true;
            if (!isInChain) applyOverride(config, path, value);
        }
    }
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
        applyRemedy(config, arguments.changes, arguments.methods, profile);
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
        const Study all = wireExperiment(std::move(whole), registry);
        runs.push_back({profile, wireExperiment(std::move(asked), registry)});
        for (const auto& [id, count] : variantsWithout(runs.back().wired))
            if (runsSomewhere(all, id)) runs.back().wired.deselected.push_back(id);
    }
    return runs;
}

/// A file next to the matrix: "matrix.yaml", ".csv" -> "matrix.csv".
std::filesystem::path fileOfMatrix(const std::filesystem::path& matrix, const char* ending) {
    return matrix.parent_path() / (matrix.stem().string() + ending);
}

struct Outcome {
    int status = 0;
    bool interrupted = false;
};

/// Runs the profiles one after the other, each into a folder of its own.
Outcome runProfiles(const StabilityArguments& arguments, const Registry& registry) {
    Outcome outcome;
    for (ProfileRun& run : profileRuns(arguments, registry)) {
        RunOptions options = arguments.options;
        options.scenes = arguments.scenes;
        options.sourceRoot = sourceRoot();
        options.preview = pathTracedPreview;
        options.report = false;
        options.out /= run.profile;
        if (!options.quiet) fmt::print("Profile {}\n", run.profile);
        const RunSummary summary = runExperiment(std::move(run.wired), options);
        printSummary(summary, options);
        outcome.status = std::max(outcome.status, summary.exitStatus());
        outcome.interrupted = summary.interrupted;
        if (outcome.interrupted) break;
    }
    return outcome;
}

/// Makes the tables. @return their last line.
std::string makeTables(const StabilityArguments& arguments, bool withRemedies) {
    std::vector<std::string> words{arguments.options.out.string(),
                                   fileOfMatrix(arguments.file, ".csv").string()};
    if (withRemedies) words.push_back("--remedies");
    const ScriptEnd end = runReportScript(sourceRoot(), "make_stability.py", words, OnInterrupt::End);
    if (end.status == 2) throw UsageError("{}", end.lastLine);
    if (end.status != 0) throw Error("{}", end.lastLine);
    return end.lastLine;
}

std::vector<std::string> texts(const Value& list) {
    std::vector<std::string> found;
    for (const Value& item : list.items) found.push_back(item.scalar);
    return found;
}

bool hasEntryFor(const Value& remedy, const std::string& method) {
    return std::ranges::any_of(remedy.members, [&](const auto& entry) { return isMeant(entry.key, method); });
}

std::string folderName(std::string name) {
    std::ranges::replace(name, ' ', '_');
    return name;
}

/// Runs what failed again, with the changes of each remedy, into remedies/REMEDY/METHOD/PROFILE.
Outcome runRemedies(const StabilityArguments& arguments, const Registry& registry) {
    const Value failing = readYaml(arguments.options.out / "failing.json");
    Outcome outcome;
    for (const auto& [name, remedy] : readYaml(fileOfMatrix(arguments.file, "_remedies.json")).members)
        for (const auto& [profile, methods] : failing.members)
            for (const auto& [method, scenes] : methods.members) {
                if (!hasEntryFor(remedy, method)) continue;
                StabilityArguments again = arguments;
                again.config.profile = profile;
                again.methods = {method};
                again.scenarios = texts(scenes);
                again.changes = remedy;
                again.options.out /=
                    std::filesystem::path("remedies") / folderName(name) / folderName(method);
                if (!again.options.quiet) fmt::print("Remedy for {}: {}\n", method, name);
                const Outcome part = runProfiles(again, registry);
                outcome.status = std::max(outcome.status, part.status);
                outcome.interrupted = part.interrupted;
                if (outcome.interrupted) return outcome;
            }
    return outcome;
}

/// Runs the profiles, and the remedies of what fails, and makes the tables. @return the exit status.
int stability(const StabilityArguments& given) {
    StabilityArguments arguments = given;
    if (arguments.file.empty()) arguments.file = sourceRoot() / "configs/stability/matrix.yaml";
    if (arguments.options.out.empty()) arguments.options.out = std::filesystem::path("results") / "stability";
    Registry registry;
    registerPasses(registry);

    Outcome outcome = runProfiles(arguments, registry);
    if (outcome.interrupted || arguments.options.dryRun) return outcome.status;
    std::string said = makeTables(arguments, false);
    if (arguments.remedies) {
        const Outcome again = runRemedies(arguments, registry);
        outcome.status = std::max(outcome.status, again.status);
        said = makeTables(arguments, true);
    }
    if (!arguments.options.quiet)
        fmt::print("{}{}\nPage: {}\n", readTextFile(arguments.options.out / "stability.md"), said,
                   (arguments.options.out / "stability.html").string());
    return outcome.status;
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
    command->add_flag("--remedies", arguments->remedies,
                      "Run what fails again with finer settings, one kind at a time, and say which of them "
                      "lowers each error; they stand next to the matrix, in a file that ends in "
                      "_remedies.json.");
    addConfigOptions(*command, *arguments);
    addRunOptions(
        *command, arguments->options,
        "Folder of the tables and of a results folder for each profile; default results/stability.");
    command->callback([arguments, &status] { status = stability(*arguments); });
}

}  // namespace voxray
