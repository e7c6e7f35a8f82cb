#include "experiment/variant_run.h"

#include <algorithm>

#include "base/byte_units.h"

namespace voxray {

namespace {

constexpr double kMaxImagesGiB = 8;  ///< Of the frames that are kept until they are scored.

void checkHostMemory(const MeasureSettings& measure, const ImageSettings& image) {
    const double bytesOfFrame = double(image.width) * image.height * 6 * sizeof(float);
    const double gib = comparedFrames(measure) * bytesOfFrame / kGiB;
    if (gib > kMaxImagesGiB)
        throw Error(
            "{} frames of {} x {} to compare take {:.1f} GiB of the host's memory, at most {} are allowed; "
            "raise measure.compare_every",
            comparedFrames(measure), image.width, image.height, gib, kMaxImagesGiB);
}

FrameImages downloadFrame(const Graph& graph, uint32_t number, Session& session) {
    FrameImages images{number, {}, {}};
    const Image* final = graph.image("final");
    if (!final || !*final) throw Error("no pass wrote the image 'final'");
    images.final = downloadImage(session.device(), session.stream(), *final);
    if (const Image* indirect = graph.image("indirect"); indirect && *indirect)
        images.indirect = downloadImage(session.device(), session.stream(), *indirect);
    return images;
}

/// How many times measureGraph() runs a graph.
double runsOf(const MeasureSettings& measure) {
    return 1.0 + measure.buildRepeats + measure.warmup + measure.frames;
}

/// What the second seed needs: frame 0 after as many frames as before the first one.
MeasureSettings untimed(MeasureSettings measure) {
    measure.buildRepeats = 0;
    measure.frames = 1;
    return measure;
}

/// Plans, prepares and measures a graph on the variant's scene; its memory is free again afterwards.
Measurement runGraph(Graph graph, const Setup& setup, uint64_t seed, const MeasureSettings& measure,
                     Session& session, const std::function<void(double)>& progress,
                     const std::function<void(const Graph&, const Frame&, uint32_t)>& afterFrame) {
    SceneOnDevice& scene = session.scene(setup);
    const Frame frame = frameOf(setup, scene.prepared, seed);
    session.plan(graph, frame, measure.memoryLimitMb);
    graph.prepare(frame, session.device(), session.compiler(), session.stream());
    GraphTarget target{frame, session.device(), session.stream(), *scene.tracer, scene.gpu, {}};
    if (changesInTime(setup.scene, !scene.prepared.state.scene->animation.empty()))
        target.goToFrame = [&](Frame& moved, int fromCompared) {
            session.goToFrame(setup, moved, fromCompared);
        };
    return measureGraph(graph, target, measure, progress,
                        [&](const Frame& now, uint32_t number) { afterFrame(graph, now, number); });
}

void writeFramePreviews(const std::filesystem::path& folder, const RenderedVariant& variant,
                        float exposureStops) {
    if (variant.laterFrames.empty()) return;
    std::filesystem::create_directories(folder);
    const auto write = [&](uint32_t frame, const ImageF& final, const std::optional<ImageF>& indirect) {
        const std::string end = "." + std::to_string(frame) + ".png";
        writePng(folder / ("final" + end), preview(final, exposureStops));
        if (indirect) writePng(folder / ("indirect" + end), preview(*indirect, exposureStops));
    };
    write(0, variant.final, variant.indirect);
    for (const FrameImages& later : variant.laterFrames) write(later.frame, later.final, later.indirect);
}

}  // namespace

uint64_t graphRuns(const Experiment& experiment) {
    const MeasureSettings& measure = experiment.measure;
    const bool withSecond = measure.secondSeed && !experiment.reference.isNull();
    return uint64_t(runsOf(measure) + (withSecond ? runsOf(untimed(measure)) : 0));
}

RenderedVariant renderVariant(WiredVariant& variant, const Experiment& experiment, Session& session,
                              const PreparedReference* reference,
                              const std::function<FrameReference(uint32_t)>& referenceOf,
                              const Registry& registry, bool withAovs,
                              const std::function<void(double)>& progress) {
    const MeasureSettings& measure = experiment.measure;
    checkHostMemory(measure, variant.setup.image);
    Device& device = session.device();
    const size_t messagesBefore = device.validationMessages().size();
    RenderedVariant rendered;
    VariantResult& result = rendered.result;
    std::vector<FrameImages> frames;
    std::optional<FrameImages> second;
    const uint64_t seed = variant.setup.general.seed;
    const bool withSecond = measure.secondSeed && reference;
    const double firstPart = withSecond ? runsOf(measure) / (runsOf(measure) + runsOf(untimed(measure))) : 1;
    Measurement m = runGraph(
        std::move(variant.graph), variant.setup, seed, measure, session,
        [&](double part) { progress(firstPart * part); },
        [&](const Graph& graph, const Frame& now, uint32_t number) {
            if (measure.compareEvery > 0 ? number % measure.compareEvery == 0 : number == 0)
                frames.push_back(downloadFrame(graph, number, session));
            if (withAovs && number == 0)
                rendered.aovs = downloadAovs(graph, now, session.origin(), device, session.stream());
        });
    if (withSecond)
        runGraph(
            variantGraph(variant, registry), variant.setup, seed + 1, untimed(measure), session,
            [&](double part) { progress(firstPart + (1 - firstPart) * part); },
            [&](const Graph& graph, const Frame&, uint32_t number) {
                second = downloadFrame(graph, number, session);
            });
    result.tracer = session.tracerName(variant.setup);
    result.buildMs = m.buildMs;
    result.frameMs = m.frameMs;
    result.memoryBytes = m.memoryBytes;
    result.peakBytes = m.peakBytes;
    result.rays = m.rays;
    result.passes = std::move(m.passes);
    result.values = std::move(m.values);
    if (const auto messages = device.validationMessages(); messages.size() > messagesBefore)
        throw Error("Vulkan validation: {}", messages[messagesBefore]);

    if (reference) {
        const float stops = variant.setup.image.exposureStops;
        ScoredFrame first =
            scoreFrame(frames[0], reference->images, reference->masks, reference->record, stops);
        rendered.flip = std::move(first.flip);
        rendered.indirectFlip = std::move(first.indirectFlip);
        result.scores = first.scores;
        if (second) scoreSeeds(frames[0], *second, reference->images, result.scores);
        if (measure.compareEvery > 0)
            scoreSequence(frames, *reference, first.scores, referenceOf, stops,
                          firstLightOff(variant.setup.scene), result);
    }
    rendered.final = std::move(frames[0].final);
    rendered.indirect = std::move(frames[0].indirect);
    frames.erase(frames.begin());
    rendered.laterFrames = std::move(frames);
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
    writeAovs(folder, variant.aovs);
    writeFramePreviews(folder / "frames", variant, exposureStops);
    if (!variant.indirect) return;
    writeExr(folder / "indirect.exr", *variant.indirect);
    writePng(folder / "indirect.png", preview(*variant.indirect, exposureStops));
    if (variant.indirectFlip) writePng(folder / "indirect_flip.png", *variant.indirectFlip);
}

void writeReferenceImages(const std::filesystem::path& folder, const PreparedReference& reference,
                          float exposureStops) {
    const ReferenceImages& images = reference.images;
    const auto writeLight = [&](const std::string& name, const ReferenceLight& light) {
        writeExr(folder / (name + ".exr"), light.mean);
        writeExr(folder / (name + "_a.exr"), light.a);
        writeExr(folder / (name + "_b.exr"), light.b);
        writePng(folder / (name + ".png"), preview(light.mean, exposureStops));
    };
    writeLight("final", images.final);
    writeLight("indirect", images.indirect);
    for (const PixelSelection& mask : reference.masks) {
        ImageF picture(images.final.mean.width, images.final.mean.height, 1);
        std::ranges::copy(mask.pixels, picture.data.begin());
        writePng(folder / ("mask." + mask.name + ".png"), picture);
    }
}

}  // namespace voxray
