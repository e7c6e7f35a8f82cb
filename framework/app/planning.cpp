#include "app/planning.h"

#include <fmt/format.h>

#include <string>

#include "app/source_root.h"
#include "experiment/study.h"
#include "passes/common/families.h"
#include "passes/path_trace/preview.h"

namespace voxray {

Study loadStudy(const std::filesystem::path& file, const ConfigOptions& options, const Registry& registry) {
    Study study = makeStudy(loadExperiment(file, options), registry);
    if (options.only.empty()) return study;
    ConfigOptions allOptions = options;
    allOptions.only.clear();
    const Study all = makeStudy(loadExperiment(file, allOptions), registry);
    for (const auto& [id, count] : cullCounts(study))
        if (runsSomewhere(all, id)) study.excludedPasses.push_back(id);
    return study;
}

void planExperiment(const std::filesystem::path& file, const ConfigArguments& arguments, RunOptions options,
                    const std::function<void(PreparedExperiment&)>& use) {
    Registry registry;
    registerPasses(registry);
    options.scenes = arguments.scenes;
    options.sourceRoot = sourceRoot();
    options.previewTracer = pathTracedPreview;
    PreparedExperiment prepared(loadStudy(file, arguments.config, registry), options);
    for (const std::string& warning : prepared.warnings()) fmt::print(stderr, "voxray: warning: {}\n", warning);
    use(prepared);
}

}  // namespace voxray
