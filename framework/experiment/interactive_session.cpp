#include "experiment/interactive_session.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "config/overrides.h"
#include "experiment/scene_files.h"
#include "experiment/variant_run.h"

namespace voxray {
namespace {

DeviceOptions deviceOptions(const RunOptions& options) {
    DeviceOptions device;
    device.name = options.deviceName;
    device.validation = options.validation;
    return device;
}

/// Settings for one compared frame. Warm-up frames make no difference to passes without temporal history.
MeasureSettings oneFrame(MeasureSettings measure, const Graph& graph) {
    const auto hasHistory = [](const Graph::PassInfo& pass) { return pass.warmupFrames > 0; };
    measure.buildRepeats = 0;
    measure.frames = 1;
    if (std::ranges::none_of(graph.passes(), hasHistory)) measure.warmup = 0;
    return measure;
}

}  // namespace

InteractiveSession::InteractiveSession(Experiment experiment, const Registry& registry, const RunOptions& options)
    : registry_(registry),
      opened_(std::move(experiment)),
      session_(deviceOptions(options), options.sourceRoot,
               sceneFolders(options.scenes, options.sourceRoot, opened_.file)),
      viewChecks_(options.previewTracer) {
    const Study all = makeStudy(opened_, registry_);
    for (const Variant& variant : all.variants) {
        variants_.emplace_back(variant.name, variant.id);
        variantConfigs_.push_back(variant.config);
    }
    study_ = checkedStudy(variantConfigs_.front());
}

Study InteractiveSession::checkedStudy(Value config) {
    Study study = makeStudy(withConfig(opened_, std::move(config)), registry_);
    for (Variant& variant : study.variants) {
        variant.sceneKey = session_.loader().key(variant.setup.scene);
        variant.referenceHash = session_.referenceHashOf(study, variant.setup);
        session_.moveCamera(variant.setup);  // So that checks find the scene loaded
    }
    planVariants(study, session_.loader(), viewChecks_, session_.device().info());
    return study;
}

void InteractiveSession::select(const std::string& id) {
    const auto found = std::ranges::find(variants_, id, &std::pair<std::string, std::string>::second);
    if (found == variants_.end()) {
        std::vector<std::string> ids;
        for (const auto& [name, each] : variants_) ids.push_back(each);
        throw UsageError("no variant '{}'; there are {}", id, fmt::join(ids, ", "));
    }
    study_ = checkedStudy(variantConfigs_[size_t(found - variants_.begin())]);
}

void InteractiveSession::apply(Value& config, const Change& change) {
    applyOverride(config, change.path, change.value);
    if (const Value* sweep = config.find("sweep"); sweep && !sweep->members.empty())
        throw UsageError(change.value.where, "sweep: a session shows one variant; select another by its id");
}

void InteractiveSession::set(const std::string& path, const Value& value) {
    Value changed = config();
    apply(changed, {path, value});
    study_ = checkedStudy(std::move(changed));
}

std::vector<std::string> InteractiveSession::warnings() const {
    std::vector<std::string> lines = session_.warnings();
    lines.insert(lines.end(), study_.warnings.begin(), study_.warnings.end());
    return lines;
}

InteractiveSession::Rendering InteractiveSession::render(const std::function<void(double)>& progress) {
    Graph graph = study_.graphOf(variant());
    const MeasureSettings measure = oneFrame(study_.experiment.measure, graph);
    return render(std::move(graph), variant().setup, measure, progress);
}

InteractiveSession::Rendering InteractiveSession::draft(const std::vector<Change>& changes, uint32_t shrink,
                                                        const std::function<void(double)>& progress) {
    Value changed = config();
    for (const Change& change : changes) apply(changed, change);
    Study study = makeStudy(withConfig(opened_, std::move(changed)), registry_);
    Variant& variant = study.variants.front();
    Setup setup = variant.setup;
    setup.image.width = std::max(1u, setup.image.width / shrink);
    setup.image.height = std::max(1u, setup.image.height / shrink);
    MeasureSettings measure = oneFrame(study.experiment.measure, variant.graph);
    measure.warmup = 0;
    return render(std::move(variant.graph), setup, measure, progress);
}

InteractiveSession::Rendering InteractiveSession::render(Graph graph, const Setup& setup,
                                                         const MeasureSettings& measure,
                                                         const std::function<void(double)>& progress) {
    SceneOnDevice& scene = session_.scene(setup);
    const bool changes = changesInTime(setup.scene, !scene.prepared.state.scene->animation.empty());
    const std::string builtFor = fmt::format("{} {}", scene.cameraless, setup.general.seed);
    const std::string viewOf = fmt::format("{} {} {}", scene.key, setup.image.width, setup.image.height);
    const Frame frame = frameOf(setup, scene.prepared, setup.general.seed);
    std::optional<Graph> previous = std::exchange(graph_, std::nullopt);
    if (previous && builtFor == builtFor_ && !changes) graph.reuse(*previous, viewOf == viewOf_);
    builtFor_ = builtFor;
    viewOf_ = viewOf;

    Rendering rendering;
    rendering.imageSettings = setup.image;
    const Geometry& geometry = scene.prepared.state.geometry;
    rendering.sceneSize = glm::distance(geometry.boundsMin, geometry.boundsMax);
    const Camera& camera = scene.prepared.camera;
    rendering.camera.position = camera.position + scene.prepared.origin;
    rendering.camera.target = rendering.camera.position + camera.forward;
    rendering.camera.up = camera.up;
    rendering.camera.fovDegrees = glm::degrees(camera.verticalFovRadians);
    try {
        session_.plan(graph, frame, measure.memoryLimitMb);
        graph.prepare(frame, session_.device(), session_.compiler(), session_.stream());
        previous.reset();  // After its programs were shared.

        GraphTarget target{frame, session_.device(), session_.stream(), *scene.tracer, scene.gpu, {}};
        if (changes) target.goToFrame = [&](Frame& moved, int number) { session_.goToFrame(setup, moved, number); };
        const size_t messages = session_.device().validationMessages().size();
        rendering.measurement = measureGraph(graph, target, measure, progress, [&](const Frame&, uint32_t number) {
            rendering.images = downloadFrame(graph, number, session_);
        });
        if (const auto all = session_.device().validationMessages(); all.size() > messages)
            throw Error("Vulkan validation: {}", all[messages]);
    } catch (...) {
        session_.stream().discard();
        if (!changes) graph_.emplace(std::move(graph));  // The next one reuses what was built.
        throw;
    }
    for (const Graph::PassInfo& pass : graph.passes())
        if (pass.isReused) rendering.reused.push_back(pass.id);
    // After motion build passes hold what they updated from frame to frame
    if (!changes) graph_.emplace(std::move(graph));
    return rendering;
}

ScoredFrame InteractiveSession::score(const FrameImages& rendered, const std::function<void(double)>& progress) {
    if (study_.reference.isNull()) throw UsageError(config().where, "the config has no reference to score against");
    const Setup& setup = variant().setup;
    const std::string key = variant().referenceHash + " " + writeParams(setup.image).text();
    if (!reference_ || preparedFor_ != key) {
        reference_.reset();
        const ReferenceImages& images = session_.reference(study_, setup, progress);
        reference_ = prepareReference(images, session_.selectPixels(study_, setup, 0), setup.image, "");
        preparedFor_ = key;
    }
    return scoreFrame(rendered, reference_->images, reference_->masks, reference_->record, setup.image.exposureStops);
}

}  // namespace voxray
