#include "experiment/workflow.h"

#include <nlohmann/json.hpp>

#include "base/files.h"
#include "experiment/parts.h"
#include "experiment/reference_parts.h"
#include "experiment/results_folder.h"

namespace voxray {
namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

std::string planJson(PreparedExperiment& prepared, const fs::path& results,
                     const WorkflowSettings& settings) {
    Json slurm = Json::object();
    if (!settings.partition.empty()) slurm["slurm_partition"] = settings.partition;
    if (!settings.account.empty()) slurm["slurm_account"] = settings.account;
    const Json plan{{"program", settings.program},
                    {"arguments", settings.arguments},
                    {"out", results.string()},
                    {"from", settings.from.string()},
                    {"timed", !settings.untimed},
                    {"cores", settings.cores ? Json(*settings.cores) : Json(nullptr)},
                    {"threads", settings.threads},
                    {"paths_per_second", settings.pathsPerSecond},
                    {"seconds_per_run", settings.secondsPerRun},
                    {"slurm", slurm},
                    {"jobs", Json::parse(describeParts(prepared, settings.referenceParts, true)).at("jobs")}};
    return plan.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

fs::path workflowFolder(const fs::path& results) {
    return results / ReferenceParts::kFolder / "sweep";
}

std::unique_ptr<ProcessLock> writeWorkflow(PreparedExperiment& prepared, const fs::path& results,
                                           const WorkflowSettings& settings) {
    const std::string plan = planJson(prepared, results, settings);
    const ResultsFolder folder(results, prepared.experiment().setup.general.name, FolderUse::Part,
                               ProcessLock::IfHeld::Wait);
    ManifestData manifest = prepared.manifest();
    manifest.warnings = prepared.warnings();
    folder.claim(manifest);

    const fs::path workflow = workflowFolder(results), done = workflow / "done";
    fs::create_directories(done);
    auto lock = std::make_unique<ProcessLock>(workflow / ".lock", ProcessLock::Kind::Exclusive, results);
    for (const Part& part : partsOf(prepared, settings.referenceParts))
        if (part.kind == Part::Kind::Merge || !fs::exists(results / part.writes)) fs::remove(done / part.id);
    writeFileAtomically(workflow / "Snakefile",
                        readTextFile(prepared.options().sourceRoot / "framework/workflow/Snakefile"));
    writeFileAtomically(workflow / "plan.json", plan);
    return lock;
}

}  // namespace voxray
