#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>

#include "app/commands.h"
#include "app/config_options.h"
#include "app/planning.h"
#include "experiment/parts.h"
#include "experiment/results_folder.h"

namespace voxray {

namespace {

struct JobsArguments : ConfigArguments {
    std::filesystem::path file;
    RunOptions options;
    uint32_t referenceParts = 1;
    bool json = false;
    std::filesystem::path claim;
};

/// Reserves a results folder for the parts of an experiment. @throws UsageError if it has anything else.
void claimForParts(const PreparedExperiment& prepared, const std::filesystem::path& results) {
    const ResultsFolder folder(results, prepared.experiment().setup.general.name, FolderUse::Part,
                               ProcessLock::IfHeld::Wait);
    ManifestData manifest = prepared.manifest();
    manifest.warnings = prepared.warnings();
    folder.claim(manifest);
}

}  // namespace

void addJobsCommand(CLI::App& app, int&) {
    auto arguments = std::make_shared<JobsArguments>();
    CLI::App* command =
        app.add_subcommand("jobs",
                           "List the parts of an experiment for an engine that runs them: what each comes after, "
                           "the memory and cost that are predicted. 'voxray run CONFIG --part ID --out DIR' does one.");
    command->add_option("CONFIG", arguments->file, "Config file.")->required();
    command->add_flag("--json", arguments->json, "Print JSON.");
    command
        ->add_option("--reference-parts", arguments->referenceParts,
                     "How many parts each reference's samples are divided into.")
        ->type_name("N")
        ->check(CLI::Range(1, 1 << 20))
        ->capture_default_str();
    command
        ->add_option("--claim", arguments->claim,
                     "Make this results folder, and keep it for the parts of this experiment.")
        ->type_name("DIR");
    addSweepOptions(*command, *arguments);
    addDeviceOptions(*command, arguments->options);
    command->callback([arguments] {
        planExperiment(arguments->file, *arguments, arguments->options, [&](PreparedExperiment& prepared) {
            const std::string parts = describeParts(prepared, arguments->referenceParts, arguments->json);
            if (!arguments->claim.empty()) claimForParts(prepared, arguments->claim);
            fmt::print("{}", parts);
        });
    });
}

}  // namespace voxray
