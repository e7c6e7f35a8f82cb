#include "experiment/variant_run.h"

namespace voxray {

Judge makeJudge(ReferenceImages images, const ImageSettings& image, const std::string& folder) {
    Judge judge{std::move(images), {}};
    ReferenceRecord& r = judge.record;
    const ReferenceImages& ref = judge.images;
    r.folder = folder;
    r.hash = ref.hash;
    r.seconds = ref.seconds;
    r.cached = ref.cached;
    r.noise = noiseFloor(ref.final, ref.variance);
    r.indirectNoise = noiseFloor(ref.indirect, ref.indirectVariance);
    r.exposures = flipExposures(ref.final);
    r.indirectExposures = flipExposures(ref.indirect);
    const ScoreOptions total{image.exposureStops, r.exposures},
        indirect{image.exposureStops, r.indirectExposures};
    r.black = score(blackLike(ref.final), ref.final, total);
    r.constant = score(constantLike(ref.final), ref.final, total);
    r.indirectBlack = score(blackLike(ref.indirect), ref.indirect, indirect);
    r.indirectConstant = score(constantLike(ref.indirect), ref.indirect, indirect);
    return judge;
}

RenderedVariant renderVariant(const Variant& variant, const Experiment& experiment, const Registry& registry,
                              Session& session, const Judge* judge,
                              const std::function<void(double)>& progress) {
    Device& device = session.device();
    const size_t messagesBefore = device.validationMessages().size();
    RenderedVariant rendered;
    VariantResult& result = rendered.result;
    {
        // Plan, prepare, run
        SceneOnDevice& scene = session.scene(variant.setup);
        const Frame frame = frameOf(variant.setup, scene.prepared, variant.setup.general.seed);
        Graph graph = variantGraph(variant, registry);
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

    // Judge
    if (judge) {
        const float stops = variant.setup.image.exposureStops;
        result.total = score(rendered.final, judge->images.final, {stops, judge->record.exposures},
                             &rendered.flip.emplace());
        if (rendered.indirect)
            result.indirect =
                score(*rendered.indirect, judge->images.indirect, {stops, judge->record.indirectExposures},
                      &rendered.indirectFlip.emplace());
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
