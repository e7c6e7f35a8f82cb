#include "experiment/shown_state.h"

#include <algorithm>
#include <utility>

#include "config/overrides.h"
#include "experiment/interactive_session.h"
#include "experiment/variant_run.h"
#include "scene/animation.h"

namespace voxray {
namespace {

/// Settings for one compared frame. Warm-up frames make no difference to passes without temporal history.
MeasureSettings oneFrame(MeasureSettings measure, const Graph& graph) {
    const auto hasHistory = [](const Graph::PassInfo& pass) { return pass.warmupFrames > 0 && !pass.isSkipped; };
    measure.buildRepeats = 0;
    measure.frames = 1;
    if (std::ranges::none_of(graph.passes(), hasHistory)) measure.warmup = 0;
    return measure;
}

/// A config without what a page keeps from variant to variant.
Value withoutView(Value config) {
    for (const char* path : {"image", "scene.camera", "measure.frames", "measure.compare_every"})
        if (valueAt(config, path)) applyOverride(config, path, Value());
    return config;
}

void refuseSweep(const Value& config, const TextLocation& where) {
    if (const Value* sweep = config.find("sweep"); sweep && !sweep->members.empty())
        throw UsageError(where, "sweep: a session shows one variant; select another by its id");
}

}  // namespace

ShownState::ShownState(InteractiveSession& session, Value config, std::string variant)
    : session_(session),
      resources_(session.resources()),
      study_(session.checkedStudy(std::move(config))),
      variantId_(std::move(variant)) {}

void ShownState::open(Value config) {
    refuseSweep(config, config.where);
    take(session_.checkedStudy(std::move(config)));
    variantId_.clear();
}

bool ShownState::isChanged() const {
    return variantId_.empty() || withoutView(config()) != withoutView(session_.configOf(variantId_));
}

void ShownState::take(Study study) {
    study_ = std::move(study);
    if (prepared_ && prepared_->images.hash != referenceHash()) prepared_.reset();
    if (!hasReference()) session_.dropReferences();
}

void ShownState::select(const std::string& variant, const std::vector<Change>& changes) {
    Value config = session_.configAlone(variant);
    for (const Change& change : changes) apply(config, change);
    take(session_.checkedStudy(std::move(config)));
    variantId_ = session_.idOf(variant);
}

void ShownState::apply(Value& config, const Change& change) {
    applyOverride(config, change.path, change.value);
    refuseSweep(config, change.value.where);
}

void ShownState::set(const std::string& path, const Value& value) {
    Value changed = config();
    apply(changed, {path, value});
    Study study = session_.checkedStudy(std::move(changed));
    const std::string id = path.substr(0, path.find('.'));
    if (std::ranges::count(study.variants.front().culledPasses, id) > 0)
        study.warnings.push_back(fmt::format("{}: no effect on the image, which does not depend on '{}'", path, id));
    take(std::move(study));
}

std::vector<std::string> ShownState::warnings() const {
    std::vector<std::string> lines = resources_.warnings();
    lines.insert(lines.end(), study_.warnings.begin(), study_.warnings.end());
    return lines;
}

ShownState::Rendering ShownState::render(const std::function<void(double)>& progress, const ViewChoice* shown) {
    Graph graph = study_.graphOf(variant());
    if (shown) runOnlyFor(graph, *shown);
    const MeasureSettings measure = oneFrame(study_.experiment.measure, graph);
    return render(std::move(graph), variant().setup, measure, progress, shown);
}

ShownState::Rendering ShownState::draft(const std::vector<Change>& changes, uint32_t shrink,
                                        const std::function<void(double)>& progress, const ViewChoice* shown) {
    Value changed = config();
    for (const Change& change : changes) apply(changed, change);
    Study study = session_.studyOf(std::move(changed));
    Variant& variant = study.variants.front();
    Setup setup = variant.setup;
    setup.image.width = std::max(1u, setup.image.width / shrink);
    setup.image.height = std::max(1u, setup.image.height / shrink);
    if (shown) runOnlyFor(variant.graph, *shown);
    MeasureSettings measure = oneFrame(study.experiment.measure, variant.graph);
    measure.warmup = 0;
    return render(std::move(variant.graph), setup, measure, progress, shown);
}

ShownState::Rendering ShownState::render(Graph graph, const Setup& setup, const MeasureSettings& measure,
                                         const std::function<void(double)>& progress, const ViewChoice* shown) {
    rendered_.reset();
    if (!isReusable_) graph_.reset();
    SceneOnDevice& scene = resources_.scene(setup);
    const bool changes = changesInTime(setup.scene, isAnimated(*scene.prepared.state.scene));
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
        resources_.plan(graph, frame, measure.memoryLimitMb);
        graph.prepare(frame, resources_.device(), resources_.compiler(), resources_.stream());
        previous.reset();  // After its programs were shared.

        GraphTarget target{frame, resources_.device(), resources_.stream(), *scene.tracer, scene.gpu, {}};
        target.checksFrames = !shown;  // Views show NaN
        if (changes) target.goToFrame = [&](Frame& moved, int number) { resources_.goToFrame(setup, moved, number); };
        const size_t messages = resources_.device().validationMessages().size();
        rendering.measurement = measureGraph(graph, target, measure, progress, [&](const Frame& now, uint32_t number) {
            rendered_.emplace(Rendered{setup, now});
            rendered_->frame.progress = {};
            if (shown)
                rendering.view = readShown(graph, now, scene.prepared.origin, *shown);
            else
                rendering.images = downloadFrame(graph, number, resources_);
        });
        if (const auto all = resources_.device().validationMessages(); all.size() > messages)
            throw Error("Vulkan validation: {}", all[messages]);
    } catch (...) {
        resources_.stream().discard();
        rendered_.reset();
        isReusable_ = !changes;
        if (!changes) graph_.emplace(std::move(graph));  // The next one reuses what was built.
        throw;
    }
    for (const Graph::PassInfo& pass : graph.passes()) {
        if (pass.isReused) rendering.reused.push_back(pass.id);
        if (pass.isSkipped)
            std::erase_if(rendering.measurement.passes, [&](const PassCost& cost) { return cost.id == pass.id; });
    }
    if (shown && shown->name == kShowVoxels) graph.dropLast();
    // After motion build passes hold what they updated from frame to frame
    isReusable_ = !changes;
    graph_.emplace(std::move(graph));
    return rendering;
}

ProgressiveReference& ShownState::reference() {
    if (!hasReference()) throw UsageError(config().where, "the config has no reference to score against");
    return session_.reference(study_);
}

ProgressiveReference& ShownState::advanceReference(std::optional<std::chrono::milliseconds> budget) {
    ProgressiveReference& reference = this->reference();
    reference.advance(study_, budget);
    return reference;
}

ScoredFrame ShownState::score(const FrameImages& rendered) {
    ProgressiveReference& reference = this->reference();
    if (!reference.images()) reference.advance(study_, {});
    const Setup& setup = variant().setup;
    std::string key = fmt::format("{} {} {} {}", reference.hash(), reference.samples(), writeParams(setup.image).text(),
                                  writeParams(study_.experiment.measure).text());
    for (const MaskSettings& mask : study_.experiment.measure.masks) key += " " + mask.name + writeParams(mask).text();
    if (!prepared_ || preparedFor_ != key) {
        prepared_.reset();
        prepared_ = prepareReference(*reference.images(), resources_.selectPixels(study_, setup, 0), setup.image, "");
        preparedFor_ = key;
    }
    const ReferenceRecord& record = prepared_->record;
    ScoredFrame scored = scoreFrame(rendered, prepared_->images, prepared_->masks, record, setup.image.exposureStops);
    for (const auto& [column, floor] : record.noise)
        if (scored.scores.contains(column)) scored.scores[column + kNoise] = floor;
    return scored;
}

}  // namespace voxray
