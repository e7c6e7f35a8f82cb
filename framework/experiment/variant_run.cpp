#include "experiment/variant_run.h"

namespace voxray {

namespace {

void addScores(Scores& all, const char* light, const Scores& scores) {
    for (const auto& [metric, value] : scores) all[light + metric] = value;
}

}  // namespace

PreparedReference prepareReference(ReferenceImages images, const ImageSettings& image,
                                   const std::string& folder) {
    PreparedReference reference{std::move(images), {}};
    ReferenceRecord& r = reference.record;
    const ReferenceImages& ref = reference.images;
    r.folder = folder;
    r.hash = ref.hash;
    r.seconds = ref.seconds;
    r.cached = ref.cached;
    r.exposures = flipExposures(ref.final);
    r.indirectExposures = flipExposures(ref.indirect);
    const auto addLight = [&](const char* light, const ImageF& mean, const ImageF& variance,
                              const FlipExposures& exposures) {
        const ScoreOptions options{image.exposureStops, exposures};
        addScores(r.noise, light, noiseFloor(mean, variance));
        addScores(r.black, light, score({blackLike(mean), mean, options}));
        addScores(r.constant, light, score({constantLike(mean), mean, options}));
    };
    addLight(kLightPrefixes[0], ref.final, ref.variance, r.exposures);
    addLight(kLightPrefixes[1], ref.indirect, ref.indirectVariance, r.indirectExposures);
    return reference;
}

RenderedVariant renderVariant(WiredVariant& variant, const Experiment& experiment, Session& session,
                              const PreparedReference* reference,
                              const std::function<void(double)>& progress) {
    Device& device = session.device();
    const size_t messagesBefore = device.validationMessages().size();
    RenderedVariant rendered;
    VariantResult& result = rendered.result;
    {
        // Plan, prepare, run
        SceneOnDevice& scene = session.scene(variant.setup);
        const Frame frame = frameOf(variant.setup, scene.prepared, variant.setup.general.seed);
        Graph graph = std::move(variant.graph);  // Its memory is free again at the end.
        session.plan(graph, frame, experiment.measure.memoryLimitMb);
        graph.prepare(frame, device, session.compiler(), session.stream());
        GraphTarget target{frame, device, session.stream(), *scene.tracer, scene.gpu, {}};
        if (changesInTime(variant.setup.scene))
            target.goToFrame = [&](Frame& moved, int fromJudged) {
                session.goToFrame(variant.setup, moved, fromJudged);
            };
        Measurement m = measureGraph(graph, target, experiment.measure, progress);
        result.tracer = scene.tracer->name();
        result.buildMs = m.buildMs;
        result.frameMs = m.frameMs;
        result.memoryBytes = m.memoryBytes;
        result.peakBytes = m.peakBytes;
        result.rays = m.rays;
        result.passes = std::move(m.passes);
        result.values = std::move(m.values);
        rendered.final = std::move(m.final);
        rendered.indirect = std::move(m.indirect);
    }
    if (const auto messages = device.validationMessages(); messages.size() > messagesBefore)
        throw Error("Vulkan validation: {}", messages[messagesBefore]);

    // Score
    if (reference) {
        const auto addLight = [&](const char* light, const ImageF& test, const ImageF& right,
                                  const FlipExposures& exposures) {
            Comparison comparison(test, right, {variant.setup.image.exposureStops, exposures});
            addScores(result.scores, light, score(comparison));
            return std::move(comparison.flip.map);
        };
        const ReferenceImages& right = reference->images;
        rendered.flip = addLight(kLightPrefixes[0], rendered.final, right.final, reference->record.exposures);
        if (rendered.indirect)
            rendered.indirectFlip = addLight(kLightPrefixes[1], *rendered.indirect, right.indirect,
                                             reference->record.indirectExposures);
    }
    result.variant = variant.name;
    result.ok = true;
    result.device = device.info().name;
    result.sweepValues = variant.values;
    return rendered;
}

void writeVariantImages(const std::filesystem::path& folder, const RenderedVariant& variant,
                        float exposureStops) {
    writeExr(folder / "final.exr", variant.final);
    writePng(folder / "final.png", preview(variant.final, exposureStops));
    if (variant.flip) writePng(folder / "flip.png", *variant.flip);
    if (!variant.indirect) return;
    writeExr(folder / "indirect.exr", *variant.indirect);
    writePng(folder / "indirect.png", preview(*variant.indirect, exposureStops));
    if (variant.indirectFlip) writePng(folder / "indirect_flip.png", *variant.indirectFlip);
}

void writeReferenceImages(const std::filesystem::path& folder, const ReferenceImages& images,
                          float exposureStops) {
    writeExr(folder / "final.exr", images.final);
    writePng(folder / "final.png", preview(images.final, exposureStops));
    writeExr(folder / "indirect.exr", images.indirect);
    writePng(folder / "indirect.png", preview(images.indirect, exposureStops));
    writeExr(folder / "variance.exr", images.variance);
    writeExr(folder / "indirect_variance.exr", images.indirectVariance);
}

}  // namespace voxray
