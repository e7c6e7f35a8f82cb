#include "experiment/progressive_reference.h"

#include <utility>

#include "base/interrupt.h"
#include "experiment/results.h"

namespace voxray {

void ProgressiveReference::follow(const Study& study) {
    const Variant& variant = study.variants.front();
    if (hash_ == variant.referenceHash) return;
    hash_ = variant.referenceHash;
    failure_.clear();
    sum_ = {};
    images_.reset();
    samples_ = 0;
    of_ = referenceSamples(study.reference.items.front());
    images_ = session_.storedReference(hash_, variant.setup);
    if (!images_) return;
    samples_ = of_;
    graph_.reset();
}

void ProgressiveReference::advance(const Study& study, std::optional<std::chrono::milliseconds> budget) {
    const auto start = std::chrono::steady_clock::now();
    follow(study);
    if (hasFailed()) throw Error("{}", failure_);
    while (!isWhole()) {
        addSample(study);
        if (budget && std::chrono::steady_clock::now() - start >= *budget) break;
    }
}

void ProgressiveReference::addSample(const Study& study) {
    const Setup& setup = study.variants.front().setup;
    try {
        SceneOnDevice& scene = session_.scene(setup);
        Frame frame = frameOf(setup, scene.prepared, referenceSeed(setup.general.seed));
        frame.samples = {samples_, of_};
        Graph& graph = graphOn(scene, study, frame);
        RenderedPart sample = renderReference(
            graph, {frame, session_.device(), session_.stream(), *scene.tracer, scene.gpu, {}}, 0, [](double) {});
        images_.reset();
        if (samples_ == 0)
            sum_ = std::move(sample);
        else
            sum_.add(sample);
        ++samples_;
        if (!isWhole()) return;
        images_ = imagesOf(std::exchange(sum_, {}));
        images_->hash = hash_;
    } catch (const std::exception& error) {
        session_.stream().discard();
        if (interruptRequested()) throw Interrupted();
        failure_ = std::string("reference: ") + error.what();
        throw Error("{}", failure_);
    }
    session_.storeReference(*images_);
}

Graph& ProgressiveReference::graphOn(const SceneOnDevice& scene, const Study& study, const Frame& frame) {
    std::string key = fmt::format("{} {}x{} {}", scene.version, frame.width, frame.height, study.reference.text());
    if (graph_ && graphOf_ == key) return *graph_;
    graph_.reset();
    Graph graph = study.referenceGraph();
    session_.plan(graph, frame, 0);
    graph.prepare(frame, session_.device(), session_.compiler(), session_.stream());
    graphOf_ = std::move(key);
    return graph_.emplace(std::move(graph));
}

const ReferenceImages* ProgressiveReference::images() {
    const bool hasHalves = sum_.sums.final[0].samples > 0 && sum_.sums.final[1].samples > 0;
    if (!images_ && hasHalves) {
        images_ = imagesOf(sum_);
        images_->hash = hash_;
    }
    return images_ ? &*images_ : nullptr;
}

Scores ProgressiveReference::noise() {
    const ReferenceImages* all = images();
    if (!all) return {};
    Scores noise;
    const std::string column = "nrmse";
    noise[kLightPrefixes[0] + column] = nRmse(all->final.a, all->final.mean);
    noise[kLightPrefixes[1] + column] = nRmse(all->indirect.a, all->indirect.mean);
    return noise;
}

}  // namespace voxray
