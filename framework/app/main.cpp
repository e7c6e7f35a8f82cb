#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include "app/commands.h"
#include "base/error.h"
#include "base/one_line.h"
#include "base/suggest.h"

namespace {

using namespace voxray;

constexpr int kFailed = 1;
constexpr int kBadUsage = 2;

int printError(const std::string& message, int status) {
    fmt::print(stderr, "voxray: error: {}\n", oneLine(message));
    return status;
}

/// @throws UsageError for an unknown command, with a hint for commands of the launcher.
void checkCommandName(const CLI::App& app, const std::string& word) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands({})) {
        if (command->get_name() == word) return;
        names.push_back(command->get_name());
    }
    if (word == "test" || word == "bench") throw UsageError("'{0}' is a command of the launcher: ./voxray {0}", word);
    if (word.ends_with(".yaml") || word.ends_with(".yml"))
        throw UsageError("unknown command '{0}'; to render a config, write: voxray run {0}", word);
    throw UsageError("unknown command '{}'{}", word, didYouMean(word, names));
}

/// "; see voxray run --help" for the given command.
std::string seeHelp(const CLI::App& app) {
    const auto given = app.get_subcommands();
    return fmt::format("; see voxray {}--help", given.empty() ? "" : given[0]->get_name() + " ");
}

/// The message for an unknown argument; for an option with the most similar one.
std::string unknownArguments(const CLI::App& app) {
    const std::string first = app.remaining(true).empty() ? "" : app.remaining(true).front();
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands())
        for (const CLI::Option* option : command->get_options())
            for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    const std::string option = first.substr(0, first.find('='));
    std::string near = option.starts_with('-') ? nearest(option, names) : "";

    // A single letter: options have no short names here. The shortest name is the most common option
    std::erase_if(names, [&](const std::string& name) { return !name.starts_with("-" + option); });
    if (option.size() == 2 && !names.empty()) near = *std::ranges::min_element(names, {}, &std::string::size);
    return fmt::format("unknown {} '{}'{}", option.starts_with('-') ? "option" : "argument", option,
                       near.empty() ? seeHelp(app) : fmt::format("; did you mean '{}'?", near));
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{"Voxray: voxel global illumination, measured against a path-traced reference.", "voxray"};
    app.set_version_flag("--version", "voxray " VOXRAY_VERSION);
    app.require_subcommand(1);
    app.footer(
        "To begin: ./voxray run configs/quickstart.yaml, or with a file of your own ./voxray scene FILE "
        "--write-config OUT.yaml.\n"
        "Also: ./voxray test [FILTER] runs the tests, ./voxray bench [FILTER] the benchmarks,\n"
        "./voxray bench gpu and ./voxray bench growth those of docs/performance.md.");

    int status = 0;
    addRunCommand(app, status);
    addJobsCommand(app, status);
    addMergeCommand(app, status);
    addSweepCommand(app, status);
    addSessionCommand(app, status);
    addLookCommand(app, status);
    addValidateCommand(app, status);
    addSchemaCommand(app, status);
    addSceneCommand(app, status);
    addExportSceneCommand(app, status);
    addCompareCommand(app, status);
    addParetoCommand(app, status);
    addExplainCommand(app, status);
    addStabilityCommand(app, status);
    addTuneCommand(app, status);
    addPackCommand(app, status);
    addVerifyCommand(app, status);
    addPlanCommand(app, status);
    addPassesCommand(app, status);
    addDevicesCommand(app, status);
    addDoctorCommand(app, status);

    try {
        if (argc < 2) {
            fmt::print(stderr, "{}", app.help());
            return kBadUsage;
        }
        if (argv[1][0] != '-') checkCommandName(app, argv[1]);
        app.parse(argc, argv);
        if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
            return printError("cannot write to the standard output", kFailed);
        return status;
    } catch (const CLI::Success& success) {  // --help, --version
        return app.exit(success);
    } catch (const CLI::ExtrasError&) {
        return printError(unknownArguments(app), kBadUsage);
    } catch (const CLI::ParseError& error) {
        return printError(oneLine(error.what()) + seeHelp(app), kBadUsage);
    } catch (const UsageError& error) {
        return printError(error.what(), kBadUsage);
    } catch (const std::bad_alloc&) {
        return printError("out of memory", kFailed);
    } catch (const std::exception& error) {
        return printError(error.what(), kFailed);
    }
}
