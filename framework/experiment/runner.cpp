#include "experiment/runner.h"

#include <algorithm>
#include <map>
#include <set>

#include "base/files.h"
#include "base/interrupt.h"
#include "base/one_line.h"
#include "experiment/manifest.h"
#include "experiment/noise_parameters.h"
#include "experiment/plan_checks.h"
#include "experiment/progress.h"
#include "experiment/report_process.h"
#include "experiment/results_folder.h"
#include "experiment/session.h"
#include "experiment/variant_run.h"

namespace voxray {
namespace {

constexpr double kMiB = 1024.0 * 1024.0;

// --tracer overrides the config.
void applyTracerOption(WiredExperiment& wired, const std::string& name) {
    if (name.empty()) return;
    Experiment& experiment = wired.experiment;
    if (experiment.sweep.find("tracer"))
        throw UsageError("--tracer {}: this config sweeps over the tracer", name);
    Value value = Value::map();
    value.set("tracer", Value::fromScalar(name));
    value.find("tracer")->where = {"--tracer", 0};
    const TracerKind kind = readParams<GeneralSettings>(value, "").tracer;
    experiment.setup.general.tracer = kind;
    for (WiredVariant& variant : wired.variants) variant.setup.general.tracer = kind;
}

/// One run: the state that its steps share.
class Run {
 public:
    Run(WiredExperiment experiment, const RunOptions& options, const Registry& registry)
        : wired_(std::move(experiment)), options_(options), registry_(registry) {
        applyTracerOption(wired_, options.tracer);
        summary_.total = variants_.size();
    }

    RunSummary execute();

 private:
    void openSession();
    void renderMissing();
    void printPlan();
    void takeOverFinished();
    void runVariant(size_t index, Progress& progress);
    const PreparedReference* referenceOf(const WiredVariant& variant, Progress& progress);
    void writeTables();
    void printWarnings(Progress& progress);
    void printValidationMessages(Progress& progress);
    VariantInputs inputsOf(const WiredVariant& variant);
    std::string outcome(const VariantResult& result) const;
    std::vector<std::string> warnings() const;

    WiredExperiment wired_;
    const Experiment& experiment_ = wired_.experiment;
    std::vector<WiredVariant>& variants_ = wired_.variants;
    const RunOptions& options_;
    const Registry& registry_;
    std::optional<Session> session_;
    std::optional<ResultsFolder> folder_;
    ManifestData manifest_;
    std::vector<std::string> warnings_;        ///< More than the session's own.
    std::set<std::string> printed_;            ///< Of the warnings.
    std::vector<std::string> notes_;           ///< What a reader of the results should know, a line each.
    std::map<size_t, VariantResult> results_;  ///< By index into variants_.
    std::optional<PreparedReference> reference_;
    bool referenceIsWritten_ = true;
    RunSummary summary_;
};

RunSummary Run::execute() {
    const InterruptScope interruptScope;
    summary_.out = options_.out.empty() ? std::filesystem::path("results") / experiment_.setup.general.name
                                        : options_.out;
    try {
        openSession();
        if (options_.dryRun) {
            printPlan();
            return summary_;
        }
    } catch (const Interrupted&) {
    }
    if ((summary_.interrupted = interruptRequested())) return summary_;  // An earlier run's results stay.
    folder_.emplace(summary_.out, experiment_.setup.general.name, options_.resume);
    if (options_.resume) takeOverFinished();
    try {
        renderMissing();
    } catch (const Error& error) {  // What can't be written.
        throw Error("{}; finished variants are kept in {}, --resume goes on", error.what(),
                    summary_.out.string());
    }
    for (const auto& [index, result] : results_) ++(result.ok ? summary_.ok : summary_.failed);

    // Close the books; after an interruption of what there is
    if (!summary_.interrupted) manifest_.finished = utcNow();
    writeTables();
    if (!options_.report || results_.empty()) return summary_;
    if (summary_.interrupted && !options_.quiet)
        fmt::print(stderr,
                   "voxray: stopped; making the report of what is finished (Ctrl-C again ends that, too)\n");
    try {
        makeReport(options_.sourceRoot, folder_->path());
    } catch (const Error& error) {
        summary_.reportError = error.what();
    }
    summary_.interrupted = interruptRequested();
    return summary_;
}

void Run::renderMissing() {
    writeTables();
    Progress progress(variants_.size() - results_.size(), options_.quiet);
    printWarnings(progress);
    for (const std::string& note : notes_) progress.note(note);
    for (size_t i = 0; i < variants_.size() && !summary_.interrupted; ++i)
        if (!results_.count(i)) runVariant(i, progress);
    printValidationMessages(progress);
}

void Run::openSession() {
    DeviceOptions device;
    device.name = options_.deviceName;
    device.validation = options_.validation;
    session_.emplace(device, options_.sourceRoot,
                     sceneFolders(options_.scenes, options_.sourceRoot, experiment_.file));

    // Every scene, its parameters and files, before anything is rendered
    for (const Variant& variant : variants_) {
        session_->loader().key(variant.setup.scene);
        session_->tracerName(variant.setup);
    }
    warnings_ = checkPlans(wired_, session_->loader(), session_->device().info(), registry_);
    manifest_.experiment = &experiment_;
    for (const WiredVariant& variant : variants_) {
        manifest_.graphs.emplace_back(variant.name, variant.resolved);
        for (const char* image : {"final", "indirect"})
            manifest_.noiseParameters[image][variant.name] = noiseParameters(variant, registry_, image);
        manifest_.referenceHashes[variant.name] = session_->referenceHashOf(wired_, variant.setup);
    }
    for (const auto& [id, count] : variantsWithout(wired_))
        if (runsSomewhere(wired_, id))
            notes_.push_back(fmt::format(
                "'{}' is left out of {} of {} variants: no image that is compared depends on it there", id,
                count, variants_.size()));
    if (!wired_.reference.isNull()) manifest_.referencePass = wired_.reference.items[0];
    manifest_.device = session_->device().info();
    manifest_.requestedDevice = options_.deviceName;
    manifest_.tracer = session_->tracerName(variants_[0].setup);
    manifest_.validation = options_.validation;
    manifest_.version = VOXRAY_VERSION;
    manifest_.commit = commitOf(options_.sourceRoot);
    manifest_.started = utcNow();
}

void Run::printPlan() {
    Progress progress(variants_.size(), options_.quiet);
    printWarnings(progress);
    for (const std::string& note : notes_) progress.note(note);
    fmt::print("{}: {} variant{} on {}\n", experiment_.setup.general.name, variants_.size(),
               variants_.size() == 1 ? "" : "s", session_->device().info().name);
    for (WiredVariant& variant : variants_) {
        if (interruptRequested()) throw Interrupted();
        const PreparedScene prepared = session_->loader().prepare(variant.setup.scene);
        const Frame frame = frameOf(variant.setup, prepared, variant.setup.general.seed);
        fmt::print("{} (tracer {}, {} x {})\n", variant.name, session_->tracerName(variant.setup),
                   variant.setup.image.width, variant.setup.image.height);
        try {
            const std::vector<PassMemory> memory =
                session_->plan(variant.graph, frame, experiment_.measure.memoryLimitMb);
            const std::vector<Graph::PassInfo> passes = variant.graph.passes();
            uint64_t kept = 0;
            for (size_t i = 0; i < passes.size(); ++i) {
                fmt::print("  {:24} {:6} {:10.1f} MiB", passes[i].id,
                           passes[i].phase == Phase::Build ? "build" : "frame",
                           double(memory[i].bytes) / kMiB);
                if (memory[i].scratchBytes > 0)
                    fmt::print(" and {:.1f} MiB of scratch", double(memory[i].scratchBytes) / kMiB);
                fmt::print("\n");
                kept += memory[i].bytes;
            }
            fmt::print(
                "  {:24} {:6} {:10.1f} MiB, {:.1f} MiB with the largest scratch; the scene {:.1f} MiB\n",
                "sum", "", double(kept) / kMiB, double(peakBytes(memory)) / kMiB,
                double(gpuSceneBytes(prepared.state)) / kMiB);
            ++summary_.ok;
        } catch (const Error& error) {
            fmt::print("  would fail: {}\n", error.what());
            ++summary_.failed;
        }
    }
}

VariantInputs Run::inputsOf(const WiredVariant& variant) {
    const Value measure = writeParams(experiment_.measure);
    std::string masks;
    for (const MaskSettings& mask : experiment_.measure.masks)
        masks += mask.name + ": " + writeParams(mask).text() + " ";
    return {{"graph", variant.resolved.text()},
            {"scene", session_->loader().key(variant.setup.scene)},
            {"image", writeParams(variant.setup.image).text()},
            {"seed", std::to_string(variant.setup.general.seed)},
            {"reference", session_->referenceHashOf(wired_, variant.setup)},
            {"measure", measure.text()},
            {"masks", masks},
            {"tracer", session_->tracerName(variant.setup)},
            {"device", session_->device().info().name},
            {"driver", session_->device().info().driver}};
}

void Run::takeOverFinished() {
    for (size_t i = 0; i < variants_.size(); ++i) {
        if (auto result = folder_->finished(variants_[i].name, inputsOf(variants_[i]))) {
            results_.emplace(i, std::move(*result));
            ++summary_.resumed;
        }
    }
    const std::filesystem::path manifest = folder_->path() / "manifest.json";
    if (summary_.resumed > 0 && std::filesystem::exists(manifest)) {
        for (ReferenceRecord& record : referencesOf(readTextFile(manifest)))
            if (std::filesystem::exists(folder_->path() / "images" / record.folder))
                manifest_.references.push_back(std::move(record));
    }
    if (!options_.quiet && summary_.resumed > 0)
        fmt::print("{} of {} variants were finished already\n", summary_.resumed, variants_.size());
}

const PreparedReference* Run::referenceOf(const WiredVariant& variant, Progress& progress) {
    if (experiment_.reference.isNull()) return nullptr;
    const std::string& hash = manifest_.referenceHashes.at(variant.name);
    if (reference_ && reference_->images.hash == hash) return &*reference_;

    std::vector<PixelSelection> masks = session_->selectPixels(experiment_, variant.setup, 0);
    const ReferenceImages& images = session_->reference(wired_, variant.setup, registry_,
                                                        [&](double fraction) { progress.update(fraction); });

    const std::vector<float>& radiance = images.final.mean.data;
    if (std::ranges::all_of(radiance, [](float value) { return value == 0; }))
        warnings_.push_back(
            fmt::format("the reference of '{}' is black: no light reaches what the camera sees; './voxray "
                        "scene' tells where "
                        "the scene is, and what shines",
                        variant.name));
    printWarnings(progress);

    // The first reference is "reference"; each other one gets its own folder
    auto& records = manifest_.references;
    const auto known = std::find_if(records.begin(), records.end(),
                                    [&](const ReferenceRecord& r) { return r.hash == images.hash; });
    const std::string folder = known != records.end() ? known->folder
                               : records.empty()      ? "reference"
                                                      : fmt::format("reference.{}", records.size() + 1);
    reference_ = prepareReference(images, std::move(masks), variant.setup.image, folder);
    if (known == records.end()) records.push_back(reference_->record);
    referenceIsWritten_ = false;
    return &*reference_;
}

void Run::runVariant(size_t index, Progress& progress) {
    WiredVariant& variant = variants_[index];
    std::optional<RenderedVariant> rendered;
    VariantResult failed;
    try {
        progress.begin(experiment_.reference.isNull() ? variant.name : variant.name + ": reference");
        const PreparedReference* reference = referenceOf(variant, progress);
        progress.begin(variant.name);
        const auto update = [&](double fraction) { progress.update(fraction); };
        std::function<FrameReference(uint32_t)> referenceOfFrame;
        if (!standsStill(variant.setup.scene))
            referenceOfFrame = [&](uint32_t number) {
                return FrameReference{
                    session_->frameReference(wired_, variant.setup, registry_, number, update),
                    session_->selectPixels(experiment_, variant.setup, number)};
            };
        rendered = renderVariant(variant, experiment_, *session_, reference, referenceOfFrame, registry_,
                                 options_.aovs, update);
    } catch (const std::bad_alloc&) {
        failed.error = "out of memory";
    } catch (const std::exception& error) {
        failed.error = oneLine(error.what());
    }
    if (!rendered) session_->stream().discard();
    if (interruptRequested()) {
        summary_.interrupted = true;
        return;
    }

    // What can't be written ends the run; what was written stays
    const float stops = variant.setup.image.exposureStops;
    if (!referenceIsWritten_)
        folder_->writeImages(reference_->record.folder,
                             [&](const auto& path) { writeReferenceImages(path, *reference_, stops); });
    referenceIsWritten_ = true;
    if (rendered) {
        rendered->result.session = manifest_.started;
        const VariantInputs inputs = inputsOf(variant);
        folder_->writeImages(variant.name, [&](const auto& path) {
            writeVariantImages(path, *rendered, stops);
            writeFileAtomically(path / "result.json", resultJson(rendered->result, inputs));
        });
        results_[index] = rendered->result;
    } else {
        failed.variant = variant.name;
        failed.device = session_->device().info().name;
        failed.tracer = session_->tracerName(variant.setup);
        failed.sweepValues = variant.values;
        failed.session = manifest_.started;
        results_[index] = failed;
    }
    writeTables();
    printValidationMessages(progress);
    progress.end(outcome(results_[index]));
}

void Run::printWarnings(Progress& progress) {
    for (const std::string& warning : warnings())
        if (printed_.insert(warning).second) progress.warn(warning);
}

void Run::printValidationMessages(Progress& progress) {
    const std::vector<std::string> messages = session_->device().validationMessages();
    for (size_t& i = summary_.validationMessages; i < messages.size(); ++i)
        progress.warn("Vulkan validation: " + messages[i]);
}

std::string Run::outcome(const VariantResult& r) const {
    if (!r.ok) return fmt::format("{}: failed: {}", r.variant, r.error);
    std::string line =
        fmt::format("{}: build {:.1f} ms, frame {:.1f} ms", r.variant, r.buildMs, r.frameMs.median);
    for (const Metric& metric : metrics().first(2))
        if (const auto value = r.scores.find(metric.name); value != r.scores.end()) {
            line += fmt::format(", {} {:.4g}", metric.label, value->second);
            if (const auto own = r.scores.find(std::string(kLightPrefixes[1]) + metric.name);
                own != r.scores.end())
                line += fmt::format(" (indirect light {:.4g})", own->second);
        }
    return line;
}

std::vector<std::string> Run::warnings() const {
    std::vector<std::string> lines = session_->warnings();
    lines.insert(lines.end(), warnings_.begin(), warnings_.end());
    return lines;
}

void Run::writeTables() {
    std::vector<VariantResult> rows;
    manifest_.sessions.clear();
    for (const auto& [index, result] : results_) {
        rows.push_back(result);
        manifest_.sessions[result.session].push_back(result.variant);
    }
    manifest_.warnings = warnings();
    manifest_.notes = notes_;
    folder_->writeText("manifest.json", manifestJson(manifest_));
    folder_->writeText("results.csv", resultsCsv(rows, sweepKeys(experiment_), experiment_.measure));
    folder_->writeText("passes.csv", passesCsv(rows));

    // Tables that not every run has; what isn't written now may be there of a run that this one goes on with
    const auto writeIf = [&](bool has, const char* name, const auto& text) {
        if (has)
            folder_->writeText(name, text());
        else
            folder_->remove(name);
    };
    writeIf(std::ranges::any_of(rows, [](const VariantResult& r) { return !r.values.empty(); }), "values.csv",
            [&] { return valuesCsv(rows); });
    writeIf(experiment_.measure.compareEvery > 0, "frames.csv",
            [&] { return framesCsv(rows, experiment_.measure); });
}

}  // namespace

RunSummary runExperiment(WiredExperiment experiment, const RunOptions& options, const Registry& registry) {
    return Run(std::move(experiment), options, registry).execute();
}

RunSummary runExperiment(const Experiment& experiment, const RunOptions& options, const Registry& registry) {
    return runExperiment(wireExperiment(experiment, registry), options, registry);
}

}  // namespace voxray
