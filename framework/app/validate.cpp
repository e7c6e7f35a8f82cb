#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/config_options.h"
#include "app/planning.h"
#include "app/source_root.h"
#include "base/thread_limit.h"
#include "experiment/prepared_experiment.h"
#include "experiment/scene_files.h"
#include "passes/common/families.h"
#include "passes/path_trace/preview.h"

namespace voxray {

namespace {

struct ValidateArguments : ConfigArguments {
    std::vector<std::filesystem::path> configs;
};

/// A device with all features, since the validity of a config doesn't depend on the device.
DeviceInfo capableDevice() {
    DeviceInfo device;
    device.name = "any";
    device.rayQuery = device.rayPipeline = device.geometryShader = true;
    device.shaderInt64Atomics = true;
    device.viewports = UINT32_MAX;
    device.filteredVolumeSide = UINT32_MAX;
    device.conservativeRaster = true;
    device.sampleCounts = VK_SAMPLE_COUNT_FLAG_BITS_MAX_ENUM;
    return device;
}

/// The result of the checks of a config.
struct ConfigCheck {
    std::string verdict;   ///< For the standard output; empty if a profile is invalid.
    std::string messages;  ///< For the standard error: warnings and the first error.
    bool isDone = false;
};

/// Checks a config with the given profile, or without a profile and again with each of its profiles. Each
/// warning is reported once, with the first profile that has it.
/// @throws UsageError for the first error.
void validate(const std::filesystem::path& config, const ConfigArguments& arguments, SceneLoader& loader,
              CameraViewChecks& views, const Registry& registry, ConfigCheck& outcome) {
    const ConfigOptions& options = arguments.config;
    std::vector<std::string> profiles{options.profile};
    if (options.profile.empty())
        for (const std::string& name : profileNames(config)) profiles.push_back(name);
    std::set<std::string> reported;
    std::string verdict;
    for (const std::string& profile : profiles) {
        const std::string under =
            profile.empty() || profile == options.profile ? "" : fmt::format(" (with --profile {})", profile);
        Study study = loadStudy(config, {profile, options.assignments}, arguments.only, registry);
        planVariants(study, loader, views, capableDevice());
        for (const std::string& warning : study.warnings)
            if (reported.insert(warning).second)
                outcome.messages += fmt::format("voxray: warning: {}{}\n", warning, under);
        const size_t variants = study.variants.size();
        verdict += fmt::format("{}{}: valid, {} variant{}\n", config.string(),
                               profile.empty() ? "" : " --profile " + profile, variants, variants == 1 ? "" : "s");
    }
    outcome.verdict = std::move(verdict);
}

/// Indices of the configs, grouped by their scene so that it is loaded once; the largest groups come first.
std::vector<std::vector<size_t>> byScene(const ValidateArguments& arguments) {
    std::map<std::string, std::vector<size_t>> ofScene;
    for (size_t i = 0; i < arguments.configs.size(); ++i) {
        std::string scene;
        try {
            scene = loadExperiment(arguments.configs[i], arguments.config).setup.scene.source.name();
        } catch (const Error&) {
            scene.clear();  // The error is reported by validate().
        }
        ofScene[scene].push_back(i);
    }
    std::vector<std::vector<size_t>> groups;
    for (auto& [scene, indices] : ofScene) groups.push_back(std::move(indices));
    std::ranges::stable_sort(groups, std::greater(), &std::vector<size_t>::size);
    return groups;
}

/// Checks all configs in parallel, also after an error. @return the exit status.
int validateAll(const ValidateArguments& arguments) {
    constexpr unsigned kMaxWorkers = 4;  // Each one has scenes in memory.
    Registry registry;
    registerPasses(registry);
    std::vector<ConfigCheck> outcomes(arguments.configs.size());
    std::mutex printing;
    // Results are printed in the order of the configs, each as soon as those before it are
    size_t printed = 0;
    const auto finish = [&](ConfigCheck& outcome) {
        const std::lock_guard lock(printing);
        outcome.isDone = true;
        for (; printed < outcomes.size() && outcomes[printed].isDone; ++printed) {
            fmt::print(stderr, "{}", outcomes[printed].messages);
            fmt::print("{}", outcomes[printed].verdict);
        }
    };
    const std::vector<std::vector<size_t>> groups = byScene(arguments);
    std::atomic<size_t> next = 0;
    const auto work = [&] {
        SceneLoader loader({});
        CameraViewChecks views(pathTracedPreview);
        for (size_t group = next++; group < groups.size(); group = next++)
            for (const size_t i : groups[group]) {
                const std::filesystem::path& config = arguments.configs[i];
                loader.searchIn(sceneFolders(arguments.scenes, sourceRoot(), config));
                try {
                    validate(config, arguments, loader, views, registry, outcomes[i]);
                } catch (const Error& error) {
                    outcomes[i].messages += fmt::format("voxray: error: {}\n", error.what());
                }
                finish(outcomes[i]);
            }
    };
    std::vector<std::future<void>> workers;
    for (size_t i = 0; i < std::min<size_t>({kMaxWorkers, workerThreads(), groups.size()}); ++i)
        workers.push_back(std::async(std::launch::async, work));
    for (std::future<void>& worker : workers) worker.get();
    const auto isValid = [](const ConfigCheck& outcome) { return !outcome.verdict.empty(); };
    return std::ranges::all_of(outcomes, isValid) ? 0 : 2;
}

}  // namespace

void addValidateCommand(CLI::App& app, int& status) {
    CLI::App* command =
        app.add_subcommand("validate", "Check configs and all their profiles, scenes included, without rendering.");
    auto arguments = std::make_shared<ValidateArguments>();
    command->add_option("CONFIG", arguments->configs, "Config files.")->required();
    addSweepOptions(*command, *arguments);
    command->callback([arguments, &status] { status = validateAll(*arguments); });
}

}  // namespace voxray
