#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/config_options.h"
#include "app/source_root.h"
#include "base/error.h"
#include "base/files.h"
#include "experiment/trials.h"
#include "passes/common/families.h"

namespace voxray {

namespace {

constexpr const char* kPython = "/usr/bin/python3";

struct TuneArguments : ConfigArguments {
    std::filesystem::path file;
    std::vector<std::string> vary, targets;
    std::string minimize = "ms", tracer, device;
    double budget = 0;
    bool every = false, resume = false;
    std::filesystem::path out;
};

/// Hands over to framework/trials, which runs this program for its trials; returns only where that fails.
void tune(TuneArguments arguments) {
    Registry registry;
    registerPasses(registry);
    for (const std::string& path : arguments.vary)
        arguments.config.assignments.push_back(
            axisOfParameter(loadExperiment(arguments.file, arguments.config), path, registry));
    const Study wired = wireExperiment(loadExperiment(arguments.file, arguments.config), registry);
    const std::string space = trialsJson(wired);
    checkTargets(arguments.targets, wired.experiment.measure);
    if (arguments.out.empty())
        arguments.out = std::filesystem::path("results") / ("tune_" + wired.experiment.setup.general.name);
    if (!arguments.resume && std::filesystem::exists(arguments.out) &&
        !std::filesystem::exists(arguments.out / "space.json") && !std::filesystem::is_empty(arguments.out))
        throw UsageError("{} holds something else than a search: choose another --out",
                         arguments.out.string());
    std::filesystem::create_directories(arguments.out);
    if (arguments.resume && std::filesystem::exists(arguments.out / "space.json") &&
        readTextFile(arguments.out / "space.json") != space)
        throw UsageError("{}: another config was searched there: leave out --resume", arguments.out.string());
    writeFileAtomically(arguments.out / "space.json", space);

    const std::filesystem::path folder = arguments.file.parent_path();
    std::vector<std::string> words{kPython,
                                   (sourceRoot() / "framework/trials/make_tune.py").string(),
                                   arguments.out.string(),
                                   "--program",
                                   std::filesystem::read_symlink("/proc/self/exe").string(),
                                   "--config",
                                   arguments.file.string(),
                                   "--minimize",
                                   arguments.minimize,
                                   "--budget",
                                   fmt::format("{:.9g}", arguments.budget),
                                   "--scenes",
                                   !arguments.scenes.empty() ? arguments.scenes.string()
                                   : folder.empty()          ? "."
                                                             : folder.string()};
    for (const std::string& target : arguments.targets) words.insert(words.end(), {"--target", target});
    if (!arguments.tracer.empty()) words.insert(words.end(), {"--tracer", arguments.tracer});
    if (!arguments.device.empty()) words.insert(words.end(), {"--device", arguments.device});
    if (arguments.every) words.emplace_back("--every");
    if (arguments.resume) words.emplace_back("--resume");
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    ::execv(kPython, pointers.data());
    throw Error("can't run {}: {}", kPython, std::strerror(errno));
}

}  // namespace

void addTuneCommand(CLI::App& app, int&) {
    auto arguments = std::make_shared<TuneArguments>();
    CLI::App* command =
        app.add_subcommand("tune",
                           "Search the variants of a config's sweep for the cheapest one whose error meets a "
                           "target: small images first, the best of them at the config's own.");
    command->add_option("CONFIG", arguments->file, "Config file.")->required();
    command
        ->add_option("--target", arguments->targets,
                     "Column of results.csv and the value to meet, as in indirect_relmse=0.02. May be given "
                     "many times.")
        ->required()
        ->type_name("NAME=VALUE")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command
        ->add_option("--minimize", arguments->minimize,
                     "What is to be cheap: ms or rays (of one build and one frame) or bytes.")
        ->check(CLI::IsMember({"ms", "rays", "bytes"}))
        ->capture_default_str();
    command
        ->add_option("--vary", arguments->vary,
                     "A pass's parameter that is searched besides the sweep, over halves and doubles of its "
                     "value, as in gather.rays. May be given many times.")
        ->type_name("ID.PARAMETER")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command
        ->add_option("--budget", arguments->budget,
                     "What trials may cost, in variants of mean cost; 0: a fifth of the sweep.")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    command->add_flag("--every", arguments->every,
                      "Run the whole sweep, too, and compare: how good the choice is, what it saved.");
    command->add_flag("--resume", arguments->resume, "Keep the trials that an earlier search finished.");
    command->add_option("--tracer", arguments->tracer, "Ray tracer in place of the config's.")
        ->type_name("NAME");
    command->add_option("--device", arguments->device, "Part of a Vulkan device's name.")->type_name("NAME");
    command->add_option("--out", arguments->out, "Folder of trials; default results/tune_<experiment>.")
        ->type_name("DIR");
    addConfigOptions(*command, *arguments);
    command->callback([arguments] { tune(*arguments); });
}

}  // namespace voxray
