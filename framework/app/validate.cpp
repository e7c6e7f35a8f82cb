#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/config_options.h"
#include "app/source_root.h"
#include "experiment/plan_checks.h"
#include "experiment/scene_files.h"
#include "passes/register_passes.h"

namespace voxray {

namespace {

struct ValidateArguments : ConfigArguments {
    std::vector<std::filesystem::path> configs;
};

/// A device that has all that a pass may ask for: a config is right or wrong whatever it runs on.
DeviceInfo capableDevice() {
    DeviceInfo device;
    device.name = "any";
    device.rayQuery = device.rayPipeline = device.geometryShader = true;
    device.shaderInt64Atomics = device.floatAtomics = true;
    device.filteredVolumeSide = UINT32_MAX;
    return device;
}

/// Checks a config under the profile that is asked for, or as it stands and again under each of its
/// profiles; what is warned of is said once, with the profile where it holds under one alone. That it is
/// valid is said where all of these are. @throws UsageError for the first fault.
void validate(const std::filesystem::path& config, const ConfigOptions& options, SceneLoader& loader,
              const Registry& registry) {
    std::vector<std::string> profiles{options.profile};
    if (options.profile.empty())
        for (const std::string& name : profileNames(config)) profiles.push_back(name);
    std::set<std::string> said;
    std::string verdict;
    for (const std::string& profile : profiles) {
        const std::string under =
            profile.empty() || profile == options.profile ? "" : fmt::format(" (with --profile {})", profile);
        WiredExperiment wired =
            wireExperiment(loadExperiment(config, {profile, options.assignments}), registry);
        for (const std::string& warning : checkPlans(wired, loader, capableDevice(), registry).warnings)
            if (said.insert(warning).second) fmt::print(stderr, "voxray: warning: {}{}\n", warning, under);
        const size_t variants = wired.variants.size();
        verdict +=
            fmt::format("{}{}: valid, {} variant{}\n", config.string(),
                        profile.empty() ? "" : " --profile " + profile, variants, variants == 1 ? "" : "s");
    }
    fmt::print("{}", verdict);
}

/// Checks every config, so that one run shows the faults of all. @return the exit status.
int validateAll(const ValidateArguments& arguments) {
    Registry registry;
    registerPasses(registry);
    int status = 0;
    SceneLoader loader({});  // One for all: configs share scenes.
    for (const std::filesystem::path& config : arguments.configs) {
        loader.searchIn(sceneFolders(arguments.scenes, sourceRoot(), config));
        try {
            validate(config, arguments.config, loader, registry);
        } catch (const Error& error) {
            fmt::print(stderr, "voxray: error: {}\n", error.what());
            status = 2;
        }
    }
    return status;
}

}  // namespace

void addValidateCommand(CLI::App& app, int& status) {
    CLI::App* command = app.add_subcommand(
        "validate", "Check configs and all their profiles, scenes included, without rendering.");
    auto arguments = std::make_shared<ValidateArguments>();
    command->add_option("CONFIG", arguments->configs, "Config files.")->required();
    addConfigOptions(*command, *arguments);
    command->callback([arguments, &status] { status = validateAll(*arguments); });
}

}  // namespace voxray
