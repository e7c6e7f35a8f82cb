#include "experiment/runner.h"

#include <chrono>
#include <utility>

#include "base/interrupt.h"
#include "base/one_line.h"
#include "config/overrides.h"
#include "experiment/checks/timing_outliers.h"
#include "experiment/merge.h"
#include "experiment/part_runner.h"
#include "experiment/parts.h"
#include "experiment/report_process.h"
#include "experiment/results_folder.h"

namespace voxray {
namespace {

/// Whether all measured frames of a variant do the same work.
bool isSteady(const PreparedExperiment& prepared, const Variant& variant) {
    return prepared.experiment().measure.warmup > 0 && isStatic(variant.setup.scene);
}

/// A run of all parts of an experiment.
class Run {
 public:
    Run(PreparedExperiment& prepared, RunSummary& summary)
        : prepared_(prepared),
          summary_(summary),
          folder_(summary.out, prepared.experiment().setup.general.name,
                  prepared.options().resume ? FolderUse::Resume : FolderUse::Fresh),
          parts_(prepared, folder_),
          manifest_(prepared.manifest()) {}

    /// Runs all parts in order, then makes the report.
    void execute();

 private:
    /// Makes the report of finished variants if possible. @throws Error with the reason.
    [[noreturn]] void abort(const std::string& why);
    void loadFinished();
    void renderMissing();
    void writeTables();
    void updateTables();
    std::string buildKey(const Variant& variant);
    std::vector<std::string> timingWarnings();

    PreparedExperiment& prepared_;
    RunSummary& summary_;
    ResultsFolder folder_;
    PartRunner parts_;
    ManifestData manifest_;
    std::chrono::steady_clock::time_point nextTables_{};  ///< Earliest time to write tables between variants.
    std::vector<std::string> timing_;                     ///< Warnings of times, once all are known.
};

void Run::execute() {
    const RunOptions& options = prepared_.options();
    if (options.resume) loadFinished();
    std::string failure;
    try {
        renderMissing();
    } catch (const Error& error) {  // The results folder can't be written.
        failure = error.what();
    }
    for (const Variant& variant : prepared_.variants())
        if (variant.result) ++(variant.result->ok ? summary_.ok : summary_.failed);
    if (!failure.empty()) abort(failure);

    // Finish the tables, also after an interruption
    if (!summary_.interrupted) manifest_.finished = utcNow();
    timing_ = timingWarnings();
    for (const std::string& text : timing_) fmt::print(stderr, "voxray: warning: {}\n", text);
    writeTables();
    if (!options.report || summary_.ok + summary_.failed == 0) return;
    if (summary_.interrupted && !options.quiet)
        fmt::print(stderr, "voxray: stopped; making the report of what is finished (Ctrl-C again ends that, too)\n");
    try {
        makeReport(options.sourceRoot, folder_.path());
    } catch (const Error& error) {
        summary_.reportError = error.what();
    }
    summary_.interrupted = interruptRequested();
}

void Run::abort(const std::string& why) {
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

void Run::loadFinished() {
    for (Variant& variant : prepared_.variants()) {
        auto result = folder_.finished(variant.id, prepared_.inputsOf(variant));
        if (!result || !parts_.hasReferenceImages(variant)) continue;
        result->name = variant.name;
        variant.result = std::move(result);
        ++summary_.resumed;
    }
    if (summary_.resumed == 0) parts_.dropReferences();
    if (!prepared_.options().quiet && summary_.resumed > 0)
        fmt::print("{} of {} variants were finished already\n", summary_.resumed, prepared_.variants().size());
}

void Run::renderMissing() {
    writeTables();
    Progress progress(prepared_.variants().size() - summary_.resumed, prepared_.options().quiet);
    parts_.printWarnings(progress);
    for (const std::string& note : manifest_.notes) progress.note(note);
    if (folder_.replaced() > 0)
        progress.note(fmt::format("replaces {} finished variant{} of an earlier run; --resume would keep {}",
                                  folder_.replaced(), folder_.replaced() == 1 ? "" : "s",
                                  folder_.replaced() == 1 ? "it" : "them"));
    for (Variant& variant : prepared_.variants()) {
        if (summary_.interrupted) break;
        if (variant.result) continue;
        if (parts_.runVariant(variant, progress))
            updateTables();
        else
            summary_.interrupted = true;
        summary_.validationMessages = parts_.printValidationMessages(progress);
    }
    summary_.validationMessages = parts_.printValidationMessages(progress);
}

void Run::writeTables() {
    std::vector<VariantResult> rows;
    for (const Variant& variant : prepared_.variants())
        if (variant.result) rows.push_back(*variant.result);
    manifest_.sessions = sessionsOf(rows);
    manifest_.warnings = parts_.warnings();
    manifest_.warnings.insert(manifest_.warnings.end(), timing_.begin(), timing_.end());
    manifest_.references = parts_.references();
    folder_.writeText("manifest.json", manifestJson(manifest_));
    folder_.writeTables(rows, prepared_.experiment());
}

/// Writes the tables at most so often that it takes a twentieth of the run's time. Each time all finished
/// variants are written, which would dominate the time of thousands of variants.
void Run::updateTables() {
    const auto start = std::chrono::steady_clock::now();
    if (start < nextTables_) return;
    writeTables();
    const auto end = std::chrono::steady_clock::now();
    nextTables_ = end + 19 * (end - start);
}

/// Everything that the time of a variant's build depends on; "" if it has one-time costs.
std::string Run::buildKey(const Variant& variant) {
    if (prepared_.experiment().measure.buildRepeats == 0) return {};
    std::string text;
    for (const PassCost& cost : variant.result->passes)
        if (cost.phase == Phase::Build)
            for (const Value& pass : variant.resolved.items)
                if (passId(pass) == cost.id) text += pass.text() + "\n";
    for (const auto& [name, value] : prepared_.inputsOf(variant))
        if (name == "scene" || name == "image" || name == "seed" || name == "tracer") text += value + "\n";
    return text;
}

std::vector<std::string> Run::timingWarnings() {
    std::vector<TimedVariant> timed;
    for (const Variant& variant : prepared_.variants())
        if (variant.result) timed.push_back({&*variant.result, buildKey(variant), isSteady(prepared_, variant)});
    return timingOutliers(timed);
}

/// Whether a part was finished earlier with the same inputs.
bool isFinished(const Part& part, PreparedExperiment& prepared, const ResultsFolder& folder, const PartRunner& parts) {
    if (part.kind == Part::Kind::Reference) return ReferenceParts(folder.path()).has(part.hash, part.samples);
    const Variant& variant = prepared.variants()[part.variant];
    return folder.finished(variant.id, prepared.inputsOf(variant)) && parts.hasReferenceImages(variant);
}

/// Renders one part into a folder that may have others.
void runPart(const Part& part, PreparedExperiment& prepared, const ResultsFolder& folder, RunSummary& summary) {
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
    Variant& variant = prepared.variants()[part.variant];
    const bool isDone = parts.runVariant(variant, progress);
    summary.validationMessages = parts.printValidationMessages(progress);
    if (!isDone) throw Interrupted();
    const VariantResult& result = *variant.result;
    std::vector<std::string> warnings = parts.warnings();
    if (result.ok && !prepared.options().untimed)
        for (const std::string& text : timingOutliers({{&result, "", isSteady(prepared, variant)}})) {
            progress.warn(text);
            warnings.push_back(text);
        }
    records.store(part.id, {warnings, result.error, result.device, result.tracer, result.session});
    if (!result.ok) throw Error("{}: {}", part.id, result.error);
}

/// Runs the part that the options name.
RunSummary executePart(PreparedExperiment& prepared, RunSummary summary) {
    const Part part = partNamed(prepared, prepared.options().part);
    ManifestData manifest = prepared.manifest();
    manifest.warnings = prepared.warnings();
    {
        const ResultsFolder folder(summary.out, prepared.experiment().setup.general.name, FolderUse::Part);
        folder.claim(manifest);
        if (part.kind != Part::Kind::Merge) runPart(part, prepared, folder, summary);
    }
    return part.kind == Part::Kind::Merge ? mergeResults({summary.out}, summary.out, prepared.options()) : summary;
}

/// Prints variants and their memory without running them.
void executeDry(PreparedExperiment& prepared, RunSummary& summary) {
    Progress progress(1, prepared.options().quiet);
    for (const std::string& warning : prepared.warnings()) progress.warn(warning);
    for (const std::string& note : prepared.manifest().notes) progress.note(note);
    summary.failed = printForecasts(prepared);
    summary.ok = summary.total - summary.failed;
}

}  // namespace

RunSummary runExperiment(Study study, const RunOptions& options) {
    const InterruptScope interruptScope;
    RunSummary summary;
    summary.total = options.part.empty() ? study.variants.size() : 0;
    summary.out =
        options.out.empty() ? std::filesystem::path("results") / study.experiment.setup.general.name : options.out;
    try {
        PreparedExperiment prepared(std::move(study), options);
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
    return runExperiment(makeStudy(experiment, registry), options);
}

}  // namespace voxray
