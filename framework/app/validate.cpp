#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "app/commands.h"
#include "config/config.h"
#include "experiment/scene_setup.h"
#include "experiment/validate.h"
#include "passes/register_passes.h"

namespace voxray {

namespace {

/// Checks a config as it stands, and again under each of its profiles. @throws UsageError for the first
/// fault.
void validate(const std::filesystem::path& config, const std::filesystem::path& scenes,
              const Registry& registry) {
    SceneLoader loader(sceneFolders(scenes, VOXRAY_SOURCE_DIR, config));
    std::set<std::string> missing;
    std::vector<std::string> profiles = profileNames(config);
    profiles.insert(profiles.begin(), "");
    for (const std::string& profile : profiles) {
        const WiredExperiment wired = wireExperiment(loadExperiment(config, {profile, {}}), registry);
        for (const WiredVariant& variant : wired.variants)
            for (const std::string& file : loader.checkNames(variant.setup.scene)) missing.insert(file);
        const size_t variants = wired.variants.size();
        fmt::print("{}{}: valid, {} variant{}\n", config.string(),
                   profile.empty() ? "" : " --profile " + profile, variants, variants == 1 ? "" : "s");
    }
    for (const std::string& file : missing)
        fmt::print("{}: no file '{}' here, so the names of its materials and cameras are not checked\n",
                   config.string(), file);
}

}  // namespace

void addValidateCommand(CLI::App& app, int& status) {
    CLI::App* command =
        app.add_subcommand("validate", "Check configs and all their profiles without rendering.");
    auto configs = std::make_shared<std::vector<std::filesystem::path>>();
    command->add_option("CONFIG", *configs, "Config files.")->required();
    auto scenes = std::make_shared<std::filesystem::path>();
    command->add_option("--scenes", *scenes, "Folder in which scene files are looked for first.")
        ->type_name("DIR");
    command->callback([configs, scenes, &status] {
        Registry registry;
        registerPasses(registry);

        // Every config is looked at, so that one run shows the faults of all.
        for (const std::filesystem::path& config : *configs) {
            try {
                validate(config, *scenes, registry);
            } catch (const UsageError& error) {
                fmt::print(stderr, "voxray: error: {}\n", error.what());
                status = 2;
            }
        }
    });
}

}  // namespace voxray
