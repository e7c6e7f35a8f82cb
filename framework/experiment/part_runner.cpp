#include "experiment/part_runner.h"

#include <algorithm>
#include <map>
#include <thread>

#include "base/files.h"
#include "base/interrupt.h"
#include "base/one_line.h"
#include "base/thread_limit.h"
#include "experiment/variant_run.h"

namespace voxray {
namespace {

/// One line for the terminal: costs, then the two scores that come first in tables. Those of the indirect
/// light, which methods differ in, stand before those of the whole image.
std::string outcome(const VariantResult& r) {
    if (!r.ok) return fmt::format("{}: failed: {}", r.variant, r.error);
    std::string line =
        fmt::format("{}: build {:.1f} ms, frame {:.1f} ms", r.variant, r.buildMs, r.frameMs.median);
    for (const Metric& metric : metrics().first(2)) {
        const auto total = r.scores.find(metric.name);
        if (total == r.scores.end()) continue;
        const auto indirect = r.scores.find(std::string(kLightPrefixes[1]) + metric.name);
        line += indirect == r.scores.end() ? fmt::format(", {} {:.4g}", metric.label, total->second)
                                           : fmt::format(", indirect {} {:.4g} (total {:.4g})", metric.label,
                                                         indirect->second, total->second);
    }
    return line;
}

}  // namespace

PartRunner::PartRunner(PreparedExperiment& prepared, const ResultsFolder& folder)
    : prepared_(prepared), folder_(folder), references_(folder.references()) {
    prepared.session().takeParts(ReferenceParts(folder.path()));
    const unsigned cores = std::thread::hardware_concurrency();
    if (prepared.options().untimed)
        warnings_.emplace_back(
            "variants ran next to other work on the same machine (--untimed): their times tell nothing");
    else if (workerThreads() < cores && !prepared.options().part.starts_with("reference."))
        warnings_.push_back(
            fmt::format("variants ran on {} of {} threads (--threads)", workerThreads(), cores));
}

std::string PartRunner::referenceFolder(const std::string& hash) const {
    // Those that are there keep their names; the others get theirs in the order of the variants, so that
    // parts in other processes call them the same
    std::map<std::string, std::string> folders;  // By hash.
    std::set<std::string> taken;
    for (const ReferenceEntry& reference : references_) {
        folders[reference.hash] = reference.folder;
        taken.insert(reference.folder);
    }
    for (const WiredVariant& variant : prepared_.variants()) {
        std::string& folder = folders[prepared_.referenceHash(variant)];
        for (int number = 1; folder.empty(); ++number)
            if (const std::string name = number == 1 ? "reference" : fmt::format("reference.{}", number);
                taken.insert(name).second)
                folder = name;
    }
    return folders.at(hash);
}

bool PartRunner::hasReferenceImages(const WiredVariant& variant) const {
    const std::string& hash = prepared_.referenceHash(variant);
    return hash.empty() ||
           std::ranges::any_of(references_, [&](const ReferenceEntry& r) { return r.hash == hash; });
}

void PartRunner::dropReferences() {
    folder_.removeReferences();
    references_.clear();
}

const PreparedReference* PartRunner::referenceOf(const WiredVariant& variant, Progress& progress) {
    if (prepared_.experiment().reference.isNull()) return nullptr;
    const std::string& hash = prepared_.referenceHash(variant);
    if (reference_ && reference_->images.hash == hash) return &*reference_;

    Session& session = prepared_.session();
    std::vector<PixelSelection> masks = session.selectPixels(prepared_.experiment(), variant.setup, 0);
    const ReferenceImages& images = session.reference(prepared_.wired(), variant.setup, prepared_.registry(),
                                                      [&](double fraction) { progress.update(fraction); });

    const std::vector<float>& radiance = images.final.mean.data;
    if (std::ranges::all_of(radiance, [](float value) { return value == 0; }))
        warnings_.push_back(
            fmt::format("the reference of '{}' is black: no light reaches what the camera sees; './voxray "
                        "scene' tells where "
                        "the scene is, and what shines",
                        variant.name));
    printWarnings(progress);
    reference_ = prepareReference(images, std::move(masks), variant.setup.image, referenceFolder(hash));
    return &*reference_;
}

void PartRunner::writeReference(const WiredVariant& variant, Progress& progress) {
    const bool isKnown = reference_ && reference_->images.hash == prepared_.referenceHash(variant);
    if (!isKnown || hasReferenceImages(variant)) return;
    references_ = folder_.references();  // Another process may have been faster.
    if (hasReferenceImages(variant)) return;
    const ReferenceRecord& record = reference_->record;
    const float stops = variant.setup.image.exposureStops;
    const std::string text = referenceJson(record, prepared_.manifest().referencePass);
    folder_.writeImages(record.folder, [&](const std::filesystem::path& path) {
        writeReferenceImages(path, *reference_, stops);
        writeFileAtomically(path / "reference.json", text);
    });
    references_ = folder_.references();
    if (references_.size() == 1)
        progress.note(fmt::format("the first image, path traced: {}",
                                  (folder_.path() / "images" / record.folder / "final.png").string()));
}

std::optional<VariantResult> PartRunner::runVariant(WiredVariant& variant, Progress& progress) {
    const Experiment& experiment = prepared_.experiment();
    Session& session = prepared_.session();
    std::optional<RenderedVariant> rendered;
    VariantResult failed;
    const auto attempt = [&](const auto& work) {
        try {
            work();
        } catch (const std::bad_alloc&) {
            failed.error = "out of memory";
        } catch (const std::exception& error) {
            failed.error = oneLine(error.what());
        }
    };
    const PreparedReference* reference = nullptr;
    attempt([&] {
        progress.begin(experiment.reference.isNull() ? variant.name : variant.name + ": reference");
        reference = referenceOf(variant, progress);
    });

    // What can't be written ends the run; what was written stays. The reference comes first, to be looked at
    // while variants render
    if (!interruptRequested()) writeReference(variant, progress);
    const auto update = [&](double fraction) { progress.update(fraction); };
    if (failed.error.empty())
        attempt([&] {
            progress.begin(variant.name);
            std::function<FrameReference(uint32_t)> referenceOfFrame;
            if (!standsStill(variant.setup.scene))
                referenceOfFrame = [&](uint32_t number) {
                    return FrameReference{session.frameReference(prepared_.wired(), variant.setup,
                                                                 prepared_.registry(), number, update),
                                          session.selectPixels(experiment, variant.setup, number)};
                };
            rendered = renderVariant(variant, experiment, session, reference, referenceOfFrame,
                                     prepared_.registry(), prepared_.options().aovs, update);
        });
    if (!rendered) session.stream().discard();
    if (interruptRequested()) return {};
    if (rendered) {
        rendered->result.session = prepared_.manifest().started;
        const VariantInputs inputs = prepared_.inputsOf(variant);
        folder_.writeImages(variant.name, [&](const std::filesystem::path& path) {
            writeVariantImages(path, *rendered, variant.setup.image.exposureStops);
            writeFileAtomically(path / "result.json", resultJson(rendered->result, inputs));
        });
    } else {
        failed.variant = variant.name;
        failed.device = session.device().info().name;
        failed.tracer = session.tracerName(variant.setup);
        failed.sweepValues = variant.values;
        failed.session = prepared_.manifest().started;
    }
    const VariantResult& result = rendered ? rendered->result : failed;
    progress.end(outcome(result));
    return result;
}

void PartRunner::runReference(const Part& part, Progress& progress) {
    progress.begin(part.id);
    const WiredVariant& variant = prepared_.variants()[part.variant];
    RenderedPart rendered;
    try {
        rendered = prepared_.session().referencePart(prepared_.wired(), variant.setup, prepared_.registry(),
                                                     part.frame, part.samples,
                                                     [&](double fraction) { progress.update(fraction); });
    } catch (const Error&) {
        prepared_.session().stream().discard();
        if (interruptRequested()) throw Interrupted();
        throw;
    }
    ReferenceParts(folder_.path()).store(part.hash, part.samples, rendered);
    progress.end(part.id + ": done");
}

std::vector<std::string> PartRunner::warnings() const {
    std::vector<std::string> lines = prepared_.warnings();
    lines.insert(lines.end(), warnings_.begin(), warnings_.end());
    return lines;
}

void PartRunner::printWarnings(Progress& progress) {
    for (const std::string& warning : warnings())
        if (printed_.insert(warning).second) progress.warn(warning);
}

size_t PartRunner::printValidationMessages(Progress& progress) {
    const std::vector<std::string> messages = prepared_.session().device().validationMessages();
    for (; messages_ < messages.size(); ++messages_)
        progress.warn("Vulkan validation: " + messages[messages_]);
    return messages_;
}

}  // namespace voxray
