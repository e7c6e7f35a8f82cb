#include "app/planning.h"

#include <fmt/format.h>

#include <string>

#include "app/source_root.h"
#include "experiment/validate.h"
#include "passes/common/families.h"

namespace voxray {

WiredExperiment wireConfig(const std::filesystem::path& file, const ConfigOptions& options,
                           const Registry& registry) {
    WiredExperiment wired = wireExperiment(loadExperiment(file, options), registry);
    if (options.only.empty()) return wired;
    ConfigOptions everything = options;
    everything.only.clear();
    const WiredExperiment whole = wireExperiment(loadExperiment(file, everything), registry);
    for (const auto& [id, count] : variantsWithout(wired))
        if (runsSomewhere(whole, id)) wired.deselected.push_back(id);
    return wired;
}

void planExperiment(const std::filesystem::path& file, const ConfigArguments& arguments, RunOptions options,
                    const std::function<void(PreparedExperiment&)>& use) {
    Registry registry;
    registerPasses(registry);
    options.scenes = arguments.scenes;
    options.sourceRoot = sourceRoot();
    PreparedExperiment prepared(wireConfig(file, arguments.config, registry), options, registry);
    for (const std::string& warning : prepared.warnings())
        fmt::print(stderr, "voxray: warning: {}\n", warning);
    use(prepared);
}

}  // namespace voxray
