#include "experiment/runner.h"

#include <chrono>
#include <map>
#include <utility>

#include "base/interrupt.h"
#include "base/one_line.h"
#include "config/overrides.h"
#include "experiment/disturbances.h"
#include "experiment/forecast.h"
#include "experiment/merge.h"
#include "experiment/part_record.h"
#include "experiment/part_runner.h"
#include "experiment/report_process.h"

namespace voxray {
namespace {

/// Whether each measured frame of a variant does what the one before it did.
bool isAtRest(PreparedExperiment& prepared, size_t variant) {
    return prepared.experiment().measure.warmup > 0 && standsStill(prepared.variants()[variant].setup.scene);
}

/// One run: the state that its steps share.
class Run {
 public:
    Run(PreparedExperiment& prepared, RunSummary& summary)
        : prepared_(prepared),
          summary_(summary),
          folder_(summary.out, prepared.experiment().setup.general.name,
                  prepared.options().resume ? FolderUse::Resume : FolderUse::Fresh),
          parts_(prepared, folder_),
          manifest_(prepared.manifest()) {}

    /// All parts in order, then the report.
    void execute();

 private:
    /// Makes the report of what is finished, where there is room. @throws Error that says why the run ends.
    [[noreturn]] void giveUp(const std::string& why);
    void takeOverFinished();
    void renderMissing();
    void writeTables();
    void keepTablesFresh();
    std::string buildOf(size_t variant);
    std::vector<std::string> disturbedTimes();

    PreparedExperiment& prepared_;
    RunSummary& summary_;
    ResultsFolder folder_;
    PartRunner parts_;
    ManifestData manifest_;
    std::map<size_t, VariantResult> results_;            ///< By index of the variant.
    std::chrono::steady_clock::time_point tablesDue_{};  ///< Tables between variants are not written before.
    std::vector<std::string> disturbed_;                 ///< What is to say of times, once all are known.
};

void Run::execute() {
    const RunOptions& options = prepared_.options();
    if (options.resume) takeOverFinished();
    std::string failure;
    try {
        renderMissing();
    } catch (const Error& error) {  // What can't be written.
        failure = error.what();
    }
    for (const auto& [index, result] : results_) ++(result.ok ? summary_.ok : summary_.failed);
    if (!failure.empty()) giveUp(failure);

    // Close the books; after an interruption of what there is
    if (!summary_.interrupted) manifest_.finished = utcNow();
    disturbed_ = disturbedTimes();
    for (const std::string& text : disturbed_) fmt::print(stderr, "voxray: warning: {}\n", text);
    writeTables();
    if (!options.report || results_.empty()) return;
    if (summary_.interrupted && !options.quiet)
        fmt::print(stderr,
                   "voxray: stopped; making the report of what is finished (Ctrl-C again ends that, too)\n");
    try {
        makeReport(options.sourceRoot, folder_.path());
    } catch (const Error& error) {
        summary_.reportError = error.what();
    }
    summary_.interrupted = interruptRequested();
}

void Run::giveUp(const std::string& why) {
    const std::string kept = fmt::format("{}, {} of {} variants kept", why, summary_.ok, summary_.total);
    if (summary_.ok == 0) throw Error("{}", kept);
    std::string report;
    if (prepared_.options().report) {
        try {
            writeTables();
            makeReport(prepared_.options().sourceRoot, folder_.path());
            report = fmt::format("; report: {}", (folder_.path() / "report.html").string());
        } catch (const Error&) {
            report = "; there is no room for a report of them";
        }
    }
    throw Error("{}{}; --resume goes on", kept, report);
}

void Run::takeOverFinished() {
    std::vector<WiredVariant>& variants = prepared_.variants();
    for (size_t i = 0; i < variants.size(); ++i) {
        auto result = folder_.finished(variants[i].name, prepared_.inputsOf(variants[i]));
        if (!result || !parts_.hasReferenceImages(variants[i])) continue;
        results_.emplace(i, std::move(*result));
        ++summary_.resumed;
    }
    if (summary_.resumed == 0) parts_.dropReferences();
    if (!prepared_.options().quiet && summary_.resumed > 0)
        fmt::print("{} of {} variants were finished already\n", summary_.resumed, variants.size());
}

void Run::renderMissing() {
    writeTables();
    std::vector<WiredVariant>& variants = prepared_.variants();
    Progress progress(variants.size() - results_.size(), prepared_.options().quiet);
    parts_.printWarnings(progress);
    for (const std::string& note : manifest_.notes) progress.note(note);
    if (folder_.replaced() > 0)
        progress.note(fmt::format("replaces {} finished variant{} of an earlier run; --resume would keep {}",
                                  folder_.replaced(), folder_.replaced() == 1 ? "" : "s",
                                  folder_.replaced() == 1 ? "it" : "them"));
    for (size_t i = 0; i < variants.size() && !summary_.interrupted; ++i) {
        if (results_.count(i)) continue;
        if (auto result = parts_.runVariant(variants[i], progress)) {
            results_.emplace(i, std::move(*result));
            keepTablesFresh();
        } else {
            summary_.interrupted = true;
        }
        summary_.validationMessages = parts_.printValidationMessages(progress);
    }
    summary_.validationMessages = parts_.printValidationMessages(progress);
}

void Run::writeTables() {
    std::vector<VariantResult> rows;
    for (const auto& [index, result] : results_) rows.push_back(result);
    manifest_.sessions = sessionsOf(rows);
    manifest_.warnings = parts_.warnings();
    manifest_.warnings.insert(manifest_.warnings.end(), disturbed_.begin(), disturbed_.end());
    manifest_.references = parts_.references();
    folder_.writeText("manifest.json", manifestJson(manifest_));
    folder_.writeTables(rows, prepared_.experiment());
}

/// Writes the tables where that leaves them a twentieth of the run's time at most: each writing is of all
/// that is finished, so thousands of variants would spend more time on their tables than on themselves.
void Run::keepTablesFresh() {
    const auto begin = std::chrono::steady_clock::now();
    if (begin < tablesDue_) return;
    writeTables();
    const auto end = std::chrono::steady_clock::now();
    tablesDue_ = end + 19 * (end - begin);
}

/// What the time of a variant's build depends on; "" where its first run is timed, with what comes once.
std::string Run::buildOf(size_t variant) {
    if (prepared_.experiment().measure.buildRepeats == 0) return {};
    const WiredVariant& wired = prepared_.variants()[variant];
    std::string text;
    for (const PassCost& cost : results_.at(variant).passes)
        if (cost.phase == Phase::Build)
            for (const Value& pass : wired.resolved.items)
                if (passId(pass) == cost.id) text += pass.text() + "\n";
    for (const auto& [name, value] : prepared_.inputsOf(wired))
        if (name == "scene" || name == "image" || name == "seed" || name == "tracer") text += value + "\n";
    return text;
}

std::vector<std::string> Run::disturbedTimes() {
    std::vector<TimedVariant> timed;
    for (const auto& [index, result] : results_)
        timed.push_back({&result, buildOf(index), isAtRest(prepared_, index)});
    return disturbances(timed);
}

/// Whether an earlier process did a part, with the same inputs.
bool isFinished(const Part& part, PreparedExperiment& prepared, const ResultsFolder& folder,
                const PartRunner& parts) {
    if (part.kind == Part::Kind::Reference) return ReferenceParts(folder.path()).has(part.hash, part.samples);
    const WiredVariant& variant = prepared.variants()[part.variant];
    return folder.finished(variant.name, prepared.inputsOf(variant)) && parts.hasReferenceImages(variant);
}

/// Renders one part, next to others in the folder.
void runPart(const Part& part, PreparedExperiment& prepared, const ResultsFolder& folder,
             RunSummary& summary) {
    const bool isResumed = prepared.options().resume;
    const ProcessLock lock =
        folder.lockPart(part.id, isResumed ? ProcessLock::IfHeld::Wait : ProcessLock::IfHeld::Refuse);
    PartRunner parts(prepared, folder);
    const PartRecords records(folder.path());
    Progress progress(1, prepared.options().quiet);
    parts.printWarnings(progress);
    if (isResumed && isFinished(part, prepared, folder, parts)) {
        progress.note(part.id + ": finished already");
        return;
    }
    if (part.kind == Part::Kind::Reference) {
        try {
            parts.runReference(part, progress);
        } catch (const Interrupted&) {
            throw;
        } catch (const Error& error) {
            records.store(part.id, {parts.warnings(), oneLine(error.what()), "", "", ""});
            throw;
        }
        records.store(part.id, {parts.warnings(), "", "", "", ""});
        return;
    }
    if (const auto missing = missingBefore(part, prepared); !missing.empty())
        throw UsageError("{}: it comes after all parts of '{}', which are not all in {}", part.id, missing[0],
                         folder.path().string());
    const auto result = parts.runVariant(prepared.variants()[part.variant], progress);
    summary.validationMessages = parts.printValidationMessages(progress);
    if (!result) throw Interrupted();
    std::vector<std::string> warnings = parts.warnings();
    if (result->ok && !prepared.options().untimed)
        for (const std::string& text : disturbances({{&*result, "", isAtRest(prepared, part.variant)}})) {
            progress.warn(text);
            warnings.push_back(text);
        }
    records.store(part.id, {warnings, result->error, result->device, result->tracer, result->session});
    if (!result->ok) throw Error("{}: {}", part.id, result->error);
}

/// Does the part that the options name.
RunSummary executePart(PreparedExperiment& prepared, RunSummary summary) {
    const Part part = partNamed(prepared, prepared.options().part);
    ManifestData manifest = prepared.manifest();
    manifest.warnings = prepared.warnings();
    {
        const ResultsFolder folder(summary.out, prepared.experiment().setup.general.name, FolderUse::Part);
        folder.claim(manifest);
        if (part.kind != Part::Kind::Merge) runPart(part, prepared, folder, summary);
    }
    return part.kind == Part::Kind::Merge ? mergeResults({summary.out}, summary.out, prepared.options())
                                          : summary;
}

/// Prints what a run would do.
void executeDry(PreparedExperiment& prepared, RunSummary& summary) {
    Progress progress(1, prepared.options().quiet);
    for (const std::string& warning : prepared.warnings()) progress.warn(warning);
    for (const std::string& note : prepared.manifest().notes) progress.note(note);
    summary.failed = printForecasts(prepared);
    summary.ok = summary.total - summary.failed;
}

}  // namespace

RunSummary runExperiment(WiredExperiment experiment, const RunOptions& options, const Registry& registry) {
    const InterruptScope interruptScope;
    RunSummary summary;
    summary.total = options.part.empty() ? experiment.variants.size() : 0;
    summary.out = options.out.empty()
                      ? std::filesystem::path("results") / experiment.experiment.setup.general.name
                      : options.out;
    try {
        PreparedExperiment prepared(std::move(experiment), options, registry);
        if (options.dryRun) {
            executeDry(prepared, summary);
        } else if (interruptRequested()) {
            throw Interrupted();  // An earlier run's results stay.
        } else if (options.part.empty()) {
            Run(prepared, summary).execute();
        } else {
            summary = executePart(prepared, summary);
        }
    } catch (const Interrupted&) {
        summary.interrupted = true;
    }
    return summary;
}

RunSummary runExperiment(const Experiment& experiment, const RunOptions& options, const Registry& registry) {
    return runExperiment(wireExperiment(experiment, registry), options, registry);
}

}  // namespace voxray
