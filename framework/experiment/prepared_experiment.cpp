#include "experiment/prepared_experiment.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <map>
#include <span>
#include <tuple>

#include "base/interrupt.h"
#include "experiment/checks/checks.h"
#include "experiment/checks/cost.h"
#include "experiment/checks/unused_settings.h"
#include "experiment/parts.h"
#include "experiment/scene_files.h"

namespace voxray {
namespace {

/// Replaces the config's tracer by that of --tracer.
void applyTracerOption(Study& study, const std::string& name) {
    if (name.empty()) return;
    Experiment& experiment = study.experiment;
    if (experiment.sweep.find("tracer")) throw UsageError("--tracer {}: this config sweeps over the tracer", name);
    Value value = Value::map();
    value.set("tracer", Value::fromScalar(name));
    value.find("tracer")->where = {"--tracer", 0};
    const TracerKind kind = readParams<GeneralSettings>(value, "").tracer;
    experiment.setup.general.tracer = kind;
    for (Variant& variant : study.variants) variant.setup.general.tracer = kind;
}

/// Whether no pass of the experiment needs Vulkan.
bool runsOnHost(const Study& study) {
    const auto needsNoDevice = [&](const Graph& graph) {
        return std::ranges::none_of(
            graph.passes(), [&](const Graph::PassInfo& pass) { return study.registry->find(pass.kind)->needsDevice; });
    };
    return std::ranges::all_of(study.variants, needsNoDevice, &Variant::graph) &&
           (study.reference.isNull() || needsNoDevice(study.referenceGraph()));
}

constexpr uint64_t kNoMemoryLimit = std::numeric_limits<uint64_t>::max();

/// Plans the reference's graph, once for consecutive variants with the same scene and image size.
class ReferencePlan {
 public:
    ReferencePlan(const Study& study, const DeviceInfo& device) : study_(study), device_(device) {}

    /// @param scene key of the frame's scene. @throws Error for parameters that the reference rejects.
    const Graph& graphFor(const Frame& frame, const std::string& scene) {
        const Key key{scene, frame.width, frame.height};
        if (graph_ && key == key_) return *graph_;
        graph_.reset();
        Graph graph = study_.referenceGraph();
        graph.plan(frame, device_, kNoMemoryLimit);
        key_ = key;
        return graph_.emplace(std::move(graph));
    }

 private:
    using Key = std::tuple<std::string, uint32_t, uint32_t>;
    const Study& study_;
    const DeviceInfo& device_;
    std::optional<Graph> graph_;
    Key key_;
};

/// Collects diagnostics of variants. Equal ones are reported once, with the name of the first variant.
class VariantWarnings {
 public:
    void add(const Diagnostics& found, const Variant& variant) {
        for (const Diagnostic& diagnostic : found) variants_[diagnostic.str()].push_back(variant.name);
    }
    void appendTo(std::vector<std::string>& lines) const {
        for (const auto& [text, names] : variants_)
            lines.push_back(names.size() == 1 ? fmt::format("{} ({})", text, names[0])
                                              : fmt::format("{} ({} and {} more)", text, names[0], names.size() - 1));
    }

 private:
    std::map<std::string, std::vector<std::string>> variants_;  ///< Names by message.
};

/// Plans and checks variants one after another. Consecutive ones usually share a scene, which is prepared
/// once.
class Planner {
 public:
    Planner(Study& study, SceneLoader& loader, CameraViewChecks& viewChecks, const DeviceInfo& device)
        : unusedMotionSettings(study.experiment.measure),
          study_(study),
          loader_(loader),
          viewChecks_(viewChecks),
          device_(device),
          reference_(study, device) {}

    /// @param storesMemory store the planned memory in the variant.
    void plan(Variant& variant, bool storesMemory) {
        if (variant.sceneKey.empty()) variant.sceneKey = loader_.key(variant.setup.scene);
        const PreparedScene& scene = loader_.prepareCached(variant.setup.scene, variant.sceneKey);
        const bool isNewScene = variant.sceneKey != key_;
        if (isNewScene) checkScene(variant, scene);
        selectPixels(variant, scene);
        unusedMotionSettings.add(variant, *scene.state.scene);
        try {
            const Frame frame = frameOf(variant.setup, scene, variant.setup.general.seed);
            std::vector<PassMemory> memory = variant.graph.plan(frame, device_, kNoMemoryLimit);
            if (storesMemory) variant.memory = std::move(memory);
            const bool hasReference = !study_.reference.isNull();
            const PlannedVariant planned{study_,
                                         variant,
                                         scene,
                                         isNewScene,
                                         loader_,
                                         *shadowRayCost_,
                                         visibleMetalFraction_,
                                         hasReference ? &reference_.graphFor(frame, key_) : nullptr};
            Diagnostics found;
            for (const Check<PlannedVariant> check : kVariantChecks) check(planned, found);
            warnings.add(found, variant);
        } catch (const Interrupted&) {
            throw;
        } catch (const Error& error) {
            throw UsageError("{}{}", error.what(),
                             study_.variants.size() > 1 ? fmt::format(" (variant {})", variant.name) : "");
        }
    }

    VariantWarnings warnings;
    UnusedMotionSettings unusedMotionSettings;

 private:
    void checkScene(const Variant& variant, const PreparedScene& scene) {
        key_ = variant.sceneKey;
        shadowRayCost_.emplace(scene.state);
        checkMaskNames(study_.experiment.measure.masks, *scene.state.scene);
        const ViewCheck view = viewChecks_.of(variant.setup, key_, scene);
        visibleMetalFraction_ = view.visibleMetalFraction;
        warnings.add(view.found, variant);
    }

    /// Evaluates the masks once for each scene and image size.
    void selectPixels(const Variant& variant, const PreparedScene& scene) {
        const std::vector<MaskSettings>& masks = study_.experiment.measure.masks;
        if (masks.empty() || study_.reference.isNull()) return;
        const ImageSettings& image = variant.setup.image;
        const auto [selections, isNew] = study_.masks.try_emplace(maskKey(key_, image));
        if (!isNew) return;
        selections->second = voxray::selectPixels(masks, scene.state, scene.camera, image.width, image.height);
        warnings.add(maskWarnings(masks, selections->second, scene.state), variant);
    }

    Study& study_;
    SceneLoader& loader_;
    CameraViewChecks& viewChecks_;
    const DeviceInfo& device_;
    ReferencePlan reference_;
    // Of the most recently checked scene
    std::string key_;
    std::optional<ShadowRayCost> shadowRayCost_;
    double visibleMetalFraction_ = 0;
};

}  // namespace

void planVariants(Study& study, SceneLoader& loader, CameraViewChecks& viewChecks, const DeviceInfo& device,
                  std::optional<size_t> onlyVariant) {
    Planner planner(study, loader, viewChecks, device);
    const std::span<Variant> all(study.variants);
    for (Variant& variant : onlyVariant ? all.subspan(*onlyVariant, 1) : all) {
        if (interruptRequested()) throw Interrupted();
        planner.plan(variant, !onlyVariant);
    }
    if (!onlyVariant) planner.unusedMotionSettings.throwIfAny();

    study.warnings = study.experiment.warnings;
    Diagnostics found;
    for (const Check<Study> check : kStudyChecks) check(study, found);
    for (const Diagnostic& diagnostic : found) study.warnings.push_back(diagnostic.str());
    planner.warnings.appendTo(study.warnings);
}

PreparedExperiment::PreparedExperiment(Study study, const RunOptions& options)
    : study_(std::move(study)), options_(options) {
    applyTracerOption(study_, options.tracer);
    DeviceOptions device;
    device.name = options_.deviceName;
    device.validation = options_.validation;
    const auto hasUsableDevice = [] { return whyNoDevice(listDevices()).empty(); };
    device.isHost = device.name.empty() && !device.validation && runsOnHost(study_) && !hasUsableDevice();
    session_.emplace(device, options_.sourceRoot,
                     sceneFolders(options_.scenes, options_.sourceRoot, study_.experiment.file));

    // key(), referenceHashOf() and tracerName() throw for invalid settings, so they are called first
    for (Variant& variant : study_.variants) {
        variant.sceneKey = session_->loader().key(variant.setup.scene);
        variant.referenceHash = session_->referenceHashOf(study_, variant.setup);
        session_->tracerName(variant.setup);
    }
    recordInputs();
    CameraViewChecks viewChecks(options_.previewTracer);
    planVariants(study_, session_->loader(), viewChecks, session_->device().info(), selectedVariant());
}

std::optional<size_t> PreparedExperiment::selectedVariant() {
    if (options_.part.empty()) return std::nullopt;
    const Part part = partNamed(*this, options_.part);
    if (part.kind == Part::Kind::Merge) return std::nullopt;
    return part.variant;
}

void PreparedExperiment::recordInputs() {
    manifest_.study = &study_;
    std::vector<std::string> culledPasses;
    for (const auto& [id, count] : cullCounts(study_))
        if (runsSomewhere(study_, id)) culledPasses.push_back(fmt::format("'{}' in {} variants", id, count));
    if (!culledPasses.empty())
        manifest_.notes.push_back(
            fmt::format("passes left out of some of the {} variants, because no compared image depends "
                        "on them there: {}",
                        study_.variants.size(), fmt::join(culledPasses, ", ")));
    if (!study_.reference.isNull()) manifest_.referencePass = study_.reference.items[0];
    manifest_.device = session_->device().info();
    manifest_.requestedDevice = options_.deviceName;
    manifest_.tracer = session_->tracerName(study_.variants[0].setup);
    manifest_.validation = options_.validation;
    manifest_.version = VOXRAY_VERSION;
    manifest_.commit = commitOf(options_.sourceRoot);
    manifest_.started = utcNow();
}

std::vector<std::string> PreparedExperiment::warnings() const {
    std::vector<std::string> lines = session_->warnings();
    for (const std::string& warning : study_.warnings)
        if (std::ranges::count(lines, warning) == 0) lines.push_back(warning);
    return lines;
}

VariantInputs PreparedExperiment::inputsOf(const Variant& variant) {
    const Value measure = writeParams(experiment().measure);
    std::string masks;
    for (const MaskSettings& mask : experiment().measure.masks)
        masks += mask.name + ": " + writeParams(mask).text() + " ";
    return {{"graph", variant.resolved.text()},
            {"scene", variant.sceneKey},
            {"image", writeParams(variant.setup.image).text()},
            {"seed", std::to_string(variant.setup.general.seed)},
            {"reference", variant.referenceHash},
            {"measure", measure.text()},
            {"masks", masks},
            {"tracer", session_->tracerName(variant.setup)},
            {"device", session_->device().info().name},
            {"driver", session_->device().info().driver}};
}

}  // namespace voxray
