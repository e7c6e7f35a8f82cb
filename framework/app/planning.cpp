#include "app/planning.h"

#include <fmt/format.h>

#include <string>

#include "app/source_root.h"
#include "experiment/validate.h"
#include "passes/common/families.h"

namespace voxray {

void planExperiment(const std::filesystem::path& file, const ConfigArguments& arguments, RunOptions options,
                    const std::function<void(PreparedExperiment&)>& use) {
    Registry registry;
    registerPasses(registry);
    options.scenes = arguments.scenes;
    options.sourceRoot = sourceRoot();
    PreparedExperiment prepared(wireExperiment(loadExperiment(file, arguments.config), registry), options,
                                registry);
    for (const std::string& warning : prepared.warnings())
        fmt::print(stderr, "voxray: warning: {}\n", warning);
    use(prepared);
}

}  // namespace voxray
