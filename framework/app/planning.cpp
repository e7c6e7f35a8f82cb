#include "app/planning.h"

#include <fmt/format.h>

#include <string>

#include "app/source_root.h"
#include "experiment/study.h"
#include "passes/common/families.h"
#include "passes/path_trace/preview.h"

namespace voxray {

Study loadStudy(const std::filesystem::path& file, const ConfigOptions& options, const std::vector<std::string>& only,
                const Registry& registry) {
    const Experiment experiment = loadExperiment(file, options);
    Study all = makeStudy(experiment, registry);
    if (only.empty()) return all;
    Value config = experiment.config;
    selectSweepValues(config, only, registry.filterLabels());
    Study study = makeStudy(withConfig(experiment, std::move(config)), registry);
    for (const auto& [id, count] : cullCounts(study))
        if (runsSomewhere(all, id)) study.excludedPasses.push_back(id);
    return study;
}

RunOptions completed(RunOptions options, const ConfigArguments& arguments) {
    options.scenes = arguments.scenes;
    options.sourceRoot = sourceRoot();
    options.previewTracer = pathTracedPreview;
    return options;
}

void planExperiment(const std::filesystem::path& file, const ConfigArguments& arguments, const RunOptions& options,
                    const std::function<void(PreparedExperiment&)>& use) {
    Registry registry;
    registerPasses(registry);
    const RunOptions all = completed(options, arguments);
    PreparedExperiment prepared(loadStudy(file, arguments.config, arguments.only, registry), all);
    for (const std::string& warning : prepared.warnings()) fmt::print(stderr, "voxray: warning: {}\n", warning);
    use(prepared);
}

}  // namespace voxray
