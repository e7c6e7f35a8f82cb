#include "experiment/variant_run.h"

#include <algorithm>

#include "base/byte_units.h"
#include "experiment/readback.h"
#include "scene/animation.h"

namespace voxray {

namespace {

constexpr double kMaxImagesGiB = 8;  ///< Limit of frames in memory until they are scored.

void checkHostMemory(const MeasureSettings& measure, const ImageSettings& image) {
    const double bytesOfFrame = double(image.width) * image.height * 6 * sizeof(float);
    const double gib = comparedFrames(measure) * bytesOfFrame / kGiB;
    if (gib > kMaxImagesGiB)
        throw Error(
            "{} frames of {} x {} to compare take {:.1f} GiB of the host's memory, at most {} are allowed; "
            "raise measure.compare_every",
            comparedFrames(measure), image.width, image.height, gib, kMaxImagesGiB);
}

/// Number of runs of a graph in measureGraph().
double runsOf(const MeasureSettings& measure) {
    return 1.0 + measure.buildRepeats + measure.warmup + measure.frames;
}

/// Settings for the second seed: only frame 0, after the same number of warm-up frames.
MeasureSettings untimed(MeasureSettings measure) {
    measure.buildRepeats = 0;
    measure.frames = 1;
    return measure;
}

/// Plans, prepares and measures a graph on the variant's scene, then frees its memory.
Measurement runGraph(Graph graph, const Setup& setup, uint64_t seed, const MeasureSettings& measure, Session& session,
                     const std::function<void(double)>& progress,
                     const std::function<void(const Graph&, const Frame&, uint32_t)>& afterFrame) {
    SceneOnDevice& scene = session.scene(setup);
    const Frame frame = frameOf(setup, scene.prepared, seed);
    session.plan(graph, frame, measure.memoryLimitMb);
    graph.prepare(frame, session.device(), session.compiler(), session.stream());
    GraphTarget target{frame, session.device(), session.stream(), *scene.tracer, scene.gpu, {}};
    if (changesInTime(setup.scene, isAnimated(*scene.prepared.state.scene)))
        target.goToFrame = [&](Frame& moved, int fromCompared) { session.goToFrame(setup, moved, fromCompared); };
    Measurement measured = measureGraph(graph, target, measure, progress,
                                        [&](const Frame& now, uint32_t number) { afterFrame(graph, now, number); });
    measured.tracerBuildMs = scene.tracerBuildMs;
    measured.tracerBytes = scene.tracer->memoryBytes();
    return measured;
}

ImageF previewOf(const ImageF& image, const ImageSettings& settings) {
    return preview(image, settings.exposureStops, settings.tone);
}

void writeFramePreviews(const std::filesystem::path& folder, const VariantImages& images,
                        const ImageSettings& settings) {
    if (images.laterFrames.empty()) return;
    std::filesystem::create_directories(folder);
    const auto write = [&](uint32_t frame, const ImageF& final, const std::optional<ImageF>& indirect) {
        const std::string end = "." + std::to_string(frame) + ".png";
        writePng(folder / ("final" + end), previewOf(final, settings));
        if (indirect) writePng(folder / ("indirect" + end), previewOf(*indirect, settings));
    };
    write(0, images.final, images.indirect);
    for (const FrameImages& later : images.laterFrames) write(later.frame, later.final, later.indirect);
}

}  // namespace

FrameImages downloadFrame(const Graph& graph, uint32_t number, Session& session) {
    FrameImages images{number, {}, {}};
    const Image* final = graph.image(kComparedImage);
    if (!final || !*final) throw Error("no pass wrote the image '{}'", kComparedImage);
    images.final = downloadImage(session.device(), session.stream(), *final);
    if (const Image* indirect = graph.image(kIndirectImage); indirect && *indirect)
        images.indirect = downloadImage(session.device(), session.stream(), *indirect);
    return images;
}

uint64_t graphRuns(const Experiment& experiment) {
    const MeasureSettings& measure = experiment.measure;
    const bool withSecond = measure.secondSeed && !experiment.reference.isNull();
    return uint64_t(runsOf(measure) + (withSecond ? runsOf(untimed(measure)) : 0));
}

VariantImages renderVariant(Variant& variant, const Study& study, Session& session, const PreparedReference* reference,
                            const std::function<FrameReference(uint32_t)>& referenceOf, bool withAovs,
                            const std::function<void(double)>& progress) {
    const MeasureSettings& measure = study.experiment.measure;
    checkHostMemory(measure, variant.setup.image);
    Device& device = session.device();
    const size_t messagesBefore = device.validationMessages().size();
    VariantImages images;
    VariantResult result;
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
                images.aovs = downloadAovs(graph, now, session.origin(), device, session.stream());
        });
    if (withSecond)
        runGraph(
            study.graphOf(variant), variant.setup, seed + 1, untimed(measure), session,
            [&](double part) { progress(firstPart + (1 - firstPart) * part); },
            [&](const Graph& graph, const Frame&, uint32_t number) { second = downloadFrame(graph, number, session); });
    result.tracer = session.tracerName(variant.setup);
    result.buildMs = m.buildMs;
    result.frameMs = m.frameMs;
    result.memoryBytes = m.memoryBytes;
    result.peakBytes = m.peakBytes;
    result.rays = m.rays;
    result.tracerBuildMs = m.tracerBuildMs;
    result.tracerBytes = m.tracerBytes;
    result.passes = std::move(m.passes);
    result.values = std::move(m.values);
    if (const auto messages = device.validationMessages(); messages.size() > messagesBefore)
        throw Error("Vulkan validation: {}", messages[messagesBefore]);

    if (reference) {
        const float stops = variant.setup.image.exposureStops;
        ScoredFrame first = scoreFrame(frames[0], reference->images, reference->masks, reference->record, stops);
        images.flip = std::move(first.flip);
        images.indirectFlip = std::move(first.indirectFlip);
        result.scores = first.scores;
        if (second) scoreSeeds(frames[0], *second, reference->images, result.scores);
        if (measure.compareEvery > 0)
            scoreSequence(frames, *reference, first.scores, referenceOf, stops, firstLightOff(variant.setup.scene),
                          result);
    }
    images.final = std::move(frames[0].final);
    images.indirect = std::move(frames[0].indirect);
    frames.erase(frames.begin());
    images.laterFrames = std::move(frames);
    result.variant = variant.id;
    result.name = variant.name;
    result.ok = true;
    result.device = device.info().name;
    result.sweepValues = variant.values;
    variant.result = std::move(result);
    return images;
}

void writeVariantImages(const std::filesystem::path& folder, const VariantImages& images,
                        const ImageSettings& settings) {
    writeExr(folder / "final.exr", images.final);
    writePng(folder / "final.png", previewOf(images.final, settings));
    if (images.flip) writePng(folder / "flip.png", *images.flip);
    for (const AovImage& aov : images.aovs) writeExr(folder / ("aovs." + aov.pass + ".exr"), aov.image, aov.channels);
    writeFramePreviews(folder / "frames", images, settings);
    if (!images.indirect) return;
    writeExr(folder / "indirect.exr", *images.indirect);
    writePng(folder / "indirect.png", previewOf(*images.indirect, settings));
    if (images.indirectFlip) writePng(folder / "indirect_flip.png", *images.indirectFlip);
}

void writeReferenceImages(const std::filesystem::path& folder, const PreparedReference& reference,
                          const ImageSettings& settings) {
    const ReferenceImages& images = reference.images;
    const auto writeLight = [&](const std::string& name, const ReferenceLight& light) {
        writeExr(folder / (name + ".exr"), light.mean);
        writeExr(folder / (name + "_a.exr"), light.a);
        writeExr(folder / (name + "_b.exr"), light.b);
        writePng(folder / (name + ".png"), previewOf(light.mean, settings));
    };
    writeLight("final", images.final);
    writeLight("indirect", images.indirect);
    for (const PixelSelection& mask : reference.masks)
        writePng(folder / ("mask." + mask.name + ".png"),
                 maskPicture(mask, images.final.mean.width, images.final.mean.height));
}

ImageF maskPicture(const PixelSelection& mask, uint32_t width, uint32_t height) {
    ImageF picture(width, height, 1);
    std::ranges::copy(mask.pixels, picture.data.begin());
    return picture;
}

}  // namespace voxray
