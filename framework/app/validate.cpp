#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/commands.h"
#include "config/config.h"
#include "experiment/validate.h"
#include "passes/register_passes.h"

namespace voxray {

namespace {

/// Checks a config as it stands, and again under each of its profiles. @throws UsageError for the first
/// fault.
void validate(const std::filesystem::path& config, const Registry& registry) {
    std::vector<std::string> profiles = profileNames(config);
    profiles.insert(profiles.begin(), "");
    for (const std::string& profile : profiles) {
        const size_t variants =
            wireExperiment(loadExperiment(config, {profile, {}}), registry).variants.size();
        fmt::print("{}{}: valid, {} variant{}\n", config.string(),
                   profile.empty() ? "" : " --profile " + profile, variants, variants == 1 ? "" : "s");
    }
}

}  // namespace

void addValidateCommand(CLI::App& app, int& status) {
    CLI::App* command =
        app.add_subcommand("validate", "Check configs and all their profiles without rendering.");
    auto configs = std::make_shared<std::vector<std::filesystem::path>>();
    command->add_option("CONFIG", *configs, "Config files.")->required();
    command->callback([configs, &status] {
        Registry registry;
        registerPasses(registry);

        // Every config is looked at, so that one run shows the faults of all.
        for (const std::filesystem::path& config : *configs) {
            try {
                validate(config, registry);
            } catch (const UsageError& error) {
                fmt::print(stderr, "voxray: error: {}\n", error.what());
                status = 2;
            }
        }
    });
}

}  // namespace voxray
