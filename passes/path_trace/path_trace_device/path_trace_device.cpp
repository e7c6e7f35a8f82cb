#include <algorithm>
#include <span>

#include "base/error.h"
#include "passes/path_trace/path_streams/path_streams.h"
#include "passes/path_trace/path_trace_ports.h"
#include "passes/path_trace/pixel_points.h"

namespace voxray {
namespace {

/// Paths of a batch: enough to fill a GPU; on a CPU enough that its waits for each stream cost little.
constexpr uint32_t kPathsOfGpu = 1u << 20, kPathsOfCpu = 1u << 18;
/// Of a pixel in a batch: its tile is in one batch.
constexpr uint32_t kMaxSamples = 4096;
constexpr uint32_t kTilePixels = PATH_TILE * PATH_TILE;
static_assert(kMaxSamples * kTilePixels <= kPathsOfCpu);
/// Batches that are submitted together, before the host waits and tells the progress.
constexpr uint32_t kBatchesPerSubmission = 8;

/// Pixels of all tiles.
uint32_t tiledPixels(const PathTraceOptions& options) {
    const auto tiles = [](uint32_t pixels) { return (pixels + PATH_TILE - 1) / PATH_TILE; };
    return tiles(options.width) * tiles(options.height) * kTilePixels;
}

}  // namespace

/// The estimator of the reference path tracer (path_tracer.h) as streams of rays on the device.
class PathTraceDevice final : public PathTracePorts {
 public:
    static constexpr const char* kName = "path_trace_device";
    static constexpr const char* kHelp =
        "Computes light by path tracing on the device, with streams of rays. "
        "The estimator, parameters and random numbers of path_trace, by the graph's ray tracer. "
        "Unbiased for its number of bounces; noisy by: spp. Source: Laine et al. 2013.";
    using Params = PathTraceParams;

    explicit PathTraceDevice(const Params& params) : PathTracePorts(params) {}
    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    /// Samples of a pixel that one batch holds: from `first` on, of those of the frame.
    struct Range {
        uint32_t first, samples;
        bool isFirst, isLast;
    };

    void traceRange(PassContext& context, const Range& range);
    void addUp(PassContext& context, const gpu::PathBatch& batch, const Range& range);
    void writeImages(PassContext& context);
    void keepSums(PassContext& context);
    /// Submits the batches so far, now and then. @throws Error where the frame is stopped.
    void submit(PassContext& context, uint64_t paths);
    /// Samples of each half.
    glm::uvec2 halfSizes() const;

    PathStreams streams_{*this};
    Kernel sumRadiance_{*this, "sum_radiance.comp"}, writeRadiance_{*this, "write_radiance.comp"};
    Kernel sumIrradiance_{*this, "sum_irradiance.comp"}, sumMoments_{*this, "sum_moments.comp"};
    Buffer pixelSums_;  ///< gpu::PixelSums of each pixel.
    uint32_t paths_ = 0;
    uint32_t batches_ = 0;  ///< Not submitted yet.
    uint64_t done_ = 0;     ///< Paths of the frame.
};

void PathTraceDevice::plan(PassPlan& plan) {
    planOutputs(plan, kName);
    const uint64_t all = uint64_t(tiledPixels(options_)) * std::min(options_.spp, kMaxSamples);
    paths_ = uint32_t(std::min<uint64_t>(all, plan.device.isCpu ? kPathsOfCpu : kPathsOfGpu));
    streams_.plan(plan, options_, paths_);
    plan.scratchBuffer(pixelSums_, "radiance of pixels",
                       uint64_t(options_.width) * options_.height * sizeof(gpu::PixelSums));
    for (Kernel* kernel : {&sumIrradiance_, &sumMoments_}) kernel->compileIf(options_.irradianceTexels > 0);
}

void PathTraceDevice::record(PassContext& context) {
    const Frame& frame = context.frame;
    options_.seed = frame.seed + context.frameIndex;
    options_.samples = frame.samples;
    const auto first = uint32_t(frame.samples.first(options_.spp)), end = uint32_t(frame.samples.end(options_.spp));
    if (first == end)
        throw Error("{}: {} samples can't be divided into {} parts", kName, options_.spp, frame.samples.parts);
    batches_ = 0;
    done_ = 0;
    streams_.begin(context);
    const uint32_t samples = std::min({end - first, paths_ / kTilePixels, kMaxSamples});
    for (uint32_t s = first; s < end; s += samples)
        traceRange(context, {s, std::min(samples, end - s), s == first, end - s <= samples});
    writeImages(context);
    if (options_.keepSums) keepSums(context);
    context.extraRays = streams_.rays(context);
}

void PathTraceDevice::traceRange(PassContext& context, const Range& range) {
    const uint32_t pixels = tiledPixels(options_);
    const uint32_t batchPixels = paths_ / range.samples / kTilePixels * kTilePixels;
    for (uint32_t p = 0; p < pixels; p += batchPixels) {
        const gpu::PathBatch batch{
            .firstPixel = p,
            .pixels = std::min(batchPixels, pixels - p),
            .firstSample = range.first,
            .samples = range.samples,
            .width = options_.width,
            .height = options_.height,
            .halves = std::min(options_.spp, 2u),
            .pointsOfPixel = path_trace::pointsOfPixel(options_),
            .seed = path_trace::hashOf(uint32_t(options_.seed), uint32_t(options_.seed >> 32)),
        };
        streams_.trace(context, batch);
        addUp(context, batch, range);
        submit(context, uint64_t(batch.pixels) * batch.samples);
    }
}

void PathTraceDevice::addUp(PassContext& context, const gpu::PathBatch& batch, const Range& range) {
    const uint32_t isFirst = range.isFirst ? 1 : 0;
    context.dispatch(sumRadiance_, batch.pixels,
                     {{"sums", streams_.sums()},
                      {"batch", batch},
                      {"pixelSums", uint64_t(pixelSums_.address())},
                      {"isFirst", isFirst}});
    if (options_.irradianceTexels == 0) return;
    const NoisyIrradiance& noisy = context[noisy_];
    const uint32_t texels = options_.irradianceTexels, block = options_.momentsPixels();
    context.dispatch(sumIrradiance_, uint64_t(batch.pixels) * texels * texels,
                     {{"sums", streams_.sums()},
                      {"irradiance", noisy.irradiance},
                      {"batch", batch},
                      {"texels", texels},
                      {"isFirst", isFirst},
                      {"isLast", range.isLast ? 1u : 0u}});
    context.dispatch(sumMoments_, batch.pixels / (block * block),
                     {{"sums", streams_.sums()},
                      {"moments", noisy.moments},
                      {"batch", batch},
                      {"block", block},
                      {"isFirst", isFirst}});
}

void PathTraceDevice::submit(PassContext& context, uint64_t paths) {
    done_ += paths;
    if (++batches_ < kBatchesPerSubmission) return;
    batches_ = 0;
    context.stream.finish();
    const auto& progress = context.frame.progress;
    const SamplePart& part = options_.samples;
    const double all = double(tiledPixels(options_)) * double(part.end(options_.spp) - part.first(options_.spp));
    if (progress && !progress(std::min(double(done_) / all, 1.0))) throw Error("path tracing was stopped");
}

glm::uvec2 PathTraceDevice::halfSizes() const {
    // Of two halves the first has the odd numbers
    const SamplePart& part = options_.samples;
    const uint64_t first = part.first(options_.spp), end = part.end(options_.spp);
    if (options_.spp == 1) return {1, 0};
    return {uint32_t(end / 2 - first / 2), uint32_t((end + 1) / 2 - (first + 1) / 2)};
}

void PathTraceDevice::writeImages(PassContext& context) {
    const glm::uvec2 sizes = halfSizes();
    for (const RenderedImage& image : images_) {
        const FrameImage& target = context[image.port];
        if (!target.isRead || !isRendered(image)) continue;
        const auto weightOf = [&](int half) {
            if (image.half >= 0) return image.half == half ? 1.0f / float(std::max(sizes[half], 1u)) : 0.0f;
            return 1.0f / float(sizes.x + sizes.y);
        };
        context.dispatch(writeRadiance_, context.frame.pixels(),
                         {{"target", target.image},
                          {"pixelSums", uint64_t(pixelSums_.address())},
                          {"weights", glm::vec2(weightOf(0), weightOf(1))},
                          {"isIndirect", image.light == PathLight::Indirect ? 1u : 0u}});
    }
}

void PathTraceDevice::keepSums(PassContext& context) {
    const size_t pixels = size_t(options_.width) * options_.height;
    const auto read = context.stream.readAs<gpu::PixelSums>(pixelSums_, pixels);
    const glm::uvec2 sizes = halfSizes();
    ReferenceSums& sums = context[sums_];
    for (int half = 0; half < 2; ++half) {
        SampleSums& final = sums.final[size_t(half)] = SampleSums(options_.width, options_.height, sizes[half]);
        SampleSums& indirect = sums.indirect[size_t(half)] = SampleSums(options_.width, options_.height, sizes[half]);
        for (size_t i = 0; i < pixels; ++i)
            for (int c = 0; c < 3; ++c) {
                const gpu::PixelSums& s = read[i];
                const double value = double(s.total[half][c]) - double(s.excessTotal[half][c]);
                final.data[3 * i + size_t(c)] = value;
                indirect.data[3 * i + size_t(c)] = double(s.indirect[half][c]) - double(s.excessIndirect[half][c]);
                if (!std::isfinite(value))
                    throw Error(
                        "{}: a sample of pixel ({}, {}) is not finite: is a light or an emission too bright for a "
                        "float?",
                        kName, i % options_.width, i / options_.width);
            }
    }
}

VOXRAY_REGISTER_PASS(PathTraceDevice);

}  // namespace voxray
