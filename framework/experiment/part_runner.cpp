#include "experiment/part_runner.h"

#include <algorithm>
#include <map>
#include <thread>

#include "base/files.h"
#include "base/interrupt.h"
#include "base/one_line.h"
#include "base/thread_limit.h"

namespace voxray {
namespace {

/// A line for the terminal: costs, then the first two metrics. Scores of indirect light, in which methods
/// differ, are before those of the whole image.
std::string outcome(const VariantResult& r) {
    if (!r.ok) return fmt::format("{}: failed: {}", r.name, r.error);
    std::string line = fmt::format("{}: build {:.1f} ms, frame {:.1f} ms", r.name, r.buildMs, r.frameMs.median);
    for (const Metric& metric : metrics().first(2)) {
        const auto total = r.scores.find(metric.name);
        if (total == r.scores.end()) continue;
        const auto indirect = r.scores.find(std::string(kLightPrefixes[1]) + metric.name);
        line += indirect == r.scores.end()
                    ? fmt::format(", {} {:.4g}", metric.label, total->second)
                    : fmt::format(", indirect {} {:.4g} (total {:.4g})", metric.label, indirect->second, total->second);
    }
    return line;
}

}  // namespace

PartRunner::PartRunner(PreparedExperiment& prepared, const ResultsFolder& folder)
    : prepared_(prepared), folder_(folder), references_(folder.references()) {
    prepared.session().setReferenceParts(ReferenceParts(folder.path()));
    const unsigned cores = std::thread::hardware_concurrency();
    if (prepared.options().untimed)
        warnings_.emplace_back(
            "variants ran next to other work on the same machine (--untimed): their times tell nothing");
    else if (workerThreads() < cores && !prepared.options().part.starts_with("reference."))
        warnings_.push_back(fmt::format("variants ran on {} of {} threads (--threads)", workerThreads(), cores));
}

std::string PartRunner::referenceFolder(const std::string& hash) const {
    // Existing references keep their names; new ones get names in the order of variants, so that parts in
    // other processes use the same names
    std::map<std::string, std::string> folders;  // By hash.
    std::set<std::string> taken;
    for (const ReferenceEntry& reference : references_) {
        folders[reference.hash] = reference.folder;
        taken.insert(reference.folder);
    }
    for (const Variant& variant : prepared_.variants()) {
        std::string& folder = folders[variant.referenceHash];
        for (int number = 1; folder.empty(); ++number)
            if (const std::string name = number == 1 ? "reference" : fmt::format("reference.{}", number);
                taken.insert(name).second)
                folder = name;
    }
    return folders.at(hash);
}

bool PartRunner::hasReferenceImages(const Variant& variant) const {
    const std::string& hash = variant.referenceHash;
    return hash.empty() || std::ranges::any_of(references_, [&](const ReferenceEntry& r) { return r.hash == hash; });
}

void PartRunner::dropReferences() {
    folder_.removeReferences();
    references_.clear();
}

const PreparedReference* PartRunner::referenceOf(const Variant& variant, Progress& progress) {
    if (prepared_.experiment().reference.isNull()) return nullptr;
    const std::string& hash = variant.referenceHash;
    if (reference_ && reference_->images.hash == hash) return &*reference_;

    Session& session = prepared_.session();
    std::vector<PixelSelection> masks = session.selectPixels(prepared_.study(), variant.setup, 0);
    const ReferenceImages& images =
        session.reference(prepared_.study(), variant.setup, [&](double fraction) { progress.update(fraction); });

    const std::vector<float>& radiance = images.final.mean.data;
    if (std::ranges::all_of(radiance, [](float value) { return value == 0; }))
        warnings_.push_back(
            fmt::format("the reference of '{}' is black: no light reaches what the camera sees; "
                        "'./voxray scene' tells where the scene is, and what shines",
                        variant.name));
    printWarnings(progress);
    PreparedReference reference =
        prepareReference(images, std::move(masks), variant.setup.image, referenceFolder(hash));
    addBaselines(reference, variant.setup.image);
    return &reference_.emplace(std::move(reference));
}

void PartRunner::writeReference(const Variant& variant, Progress& progress) {
    const bool isKnown = reference_ && reference_->images.hash == variant.referenceHash;
    if (!isKnown || hasReferenceImages(variant)) return;
    references_ = folder_.references();  // Another process may have written it.
    if (hasReferenceImages(variant)) return;
    const ReferenceRecord& record = reference_->record;
    const std::string text = referenceJson(record, prepared_.manifest().referencePass);
    folder_.writeImages(record.folder, [&](const std::filesystem::path& path) {
        writeReferenceImages(path, *reference_, variant.setup.image);
        writeFileAtomically(path / "reference.json", text);
    });
    references_ = folder_.references();
    if (references_.size() == 1)
        progress.note(fmt::format("the first image, path traced: {}",
                                  (folder_.path() / "images" / record.folder / "final.png").string()));
}

bool PartRunner::runVariant(Variant& variant, Progress& progress) {
    Session& session = prepared_.session();
    std::string failure;
    const auto attempt = [&](const auto& work) {
        try {
            work();
        } catch (const std::bad_alloc&) {
            failure = "out of memory";
        } catch (const std::exception& error) {
            failure = oneLine(error.what());
        }
    };
    const PreparedReference* reference = nullptr;
    attempt([&] {
        const bool hasReference = !prepared_.experiment().reference.isNull();
        progress.begin(hasReference ? variant.name + ": reference" : variant.name);
        reference = referenceOf(variant, progress);
    });

    // An error of writing aborts the run. The reference is written first, so that users can view it early
    if (!interruptRequested()) writeReference(variant, progress);
    VariantImages images;
    if (failure.empty())
        attempt([&] {
            progress.begin(variant.name);
            images = render(variant, reference, progress);
        });
    if (!failure.empty()) session.stream().discard();
    if (interruptRequested()) {
        variant.result.reset();
        return false;
    }
    if (!failure.empty()) {
        VariantResult& failed = variant.result.emplace();
        failed.error = failure;
        failed.variant = variant.id;
        failed.name = variant.name;
        failed.device = session.device().info().name;
        failed.tracer = session.tracerName(variant.setup);
        failed.sweepValues = variant.values;
    }
    variant.result->session = prepared_.manifest().started;
    if (failure.empty()) {
        const VariantInputs inputs = prepared_.inputsOf(variant);
        folder_.writeImages(variant.id, [&](const std::filesystem::path& path) {
            writeVariantImages(path, images, variant.setup.image);
            writeFileAtomically(path / "result.json", resultJson(*variant.result, inputs));
        });
    }
    progress.end(outcome(*variant.result));
    return true;
}

VariantImages PartRunner::render(Variant& variant, const PreparedReference* reference, Progress& progress) {
    Session& session = prepared_.session();
    const auto update = [&](double fraction) { progress.update(fraction); };
    std::function<FrameReference(uint32_t)> referenceOfFrame;
    if (!isStatic(variant.setup.scene))
        referenceOfFrame = [&](uint32_t number) {
            return FrameReference{session.frameReference(prepared_.study(), variant.setup, number, update),
                                  session.selectPixels(prepared_.study(), variant.setup, number)};
        };
    return renderVariant(variant, prepared_.study(), session, reference, referenceOfFrame, prepared_.options().aovs,
                         update);
}

void PartRunner::runReference(const Part& part, Progress& progress) {
    progress.begin(part.id);
    const Variant& variant = prepared_.variants()[part.variant];
    RenderedPart rendered;
    try {
        rendered = prepared_.session().referencePart(prepared_.study(), variant.setup, part.frame, part.samples,
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
    for (; messages_ < messages.size(); ++messages_) progress.warn("Vulkan validation: " + messages[messages_]);
    return messages_;
}

}  // namespace voxray
