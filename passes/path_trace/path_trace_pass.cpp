#include <memory>
#include <optional>
#include <utility>

#include "passes/path_trace/integrator.h"
#include "passes/path_trace/path_trace_ports.h"
#include "trace/embree_scene.h"

namespace voxray {
namespace {

/// Uploads an image of 3 or 4 channels; a missing fourth one is 1.
void upload(CommandStream& stream, const ImageF& source, const Image& target) {
    std::vector<float> rgba(source.pixelCount() * 4, 1.0f);
    for (size_t i = 0; i < source.pixelCount(); ++i)
        for (size_t c = 0; c < source.channels; ++c) rgba[4 * i + c] = source.data[source.channels * i + c];
    stream.upload(target, std::as_bytes(std::span(rgba)));
    stream.finish();
}

}  // namespace

/// The reference path tracer (path_tracer.h) as a pass: with many samples the reference of all methods, with
/// few a baseline. It shares no shader and no ray stream with the methods that it is compared with.
class PathTracePass final : public PathTracePorts {
 public:
    static constexpr const char* kName = "path_trace";
    static constexpr bool kNeedsDevice = false;
    static constexpr const char* kHelp =
        "Computes light by path tracing on the CPU with Embree. "
        "It uses next-event estimation, multiple importance sampling and Owen-scrambled Sobol points. "
        "Unbiased for its number of bounces; noisy by: spp. Writes total and indirect light, "
        "each also as two independent halves, and irradiance at the G-buffer's texels for filter_irradiance.";
    using Params = PathTraceParams;

    explicit PathTracePass(const Params& params) : PathTracePorts(params) {}
    void plan(PassPlan& plan) override { planOutputs(plan, kName); }
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    static const ImageF& pixelsOf(const RenderedImage& image, const PathTraceResult& result) {
        const bool isTotal = image.light == PathLight::All;
        if (image.half < 0) return isTotal ? result.total : result.indirect;
        return (isTotal ? result.totalHalves : result.indirectHalves)[size_t(image.half)];
    }

    std::unique_ptr<EmbreeScene> embree_;
    std::optional<path_trace::Integrator> integrator_;
    uint64_t sceneVersion_ = 0;  ///< Of the scene that the integrator was made for.
};

void PathTracePass::prepare(PassSetup& setup) {
    embree_ = std::make_unique<EmbreeScene>(*setup.frame.scene);
}

void PathTracePass::record(PassContext& context) {
    const Frame& frame = context.frame;
    options_.seed = frame.seed + context.frameIndex;
    options_.samples = frame.samples;
    context.stream.finish();
    if (frame.changedRegions && !frame.changedRegions->empty()) embree_->update();
    if (!integrator_ || sceneVersion_ != frame.sceneVersion) {
        const bool isNew = !integrator_ || sceneVersion_ + 1 != frame.sceneVersion || !frame.changedRegions;
        if (isNew)
            integrator_.emplace(*frame.scene, *embree_, options_.bounces, path_trace::Strategy::Mis, options_.light);
        else if (frame.changedRegions->empty())
            integrator_->updateLights(*frame.scene);
        else
            integrator_->updateMoving(*frame.scene);
        sceneVersion_ = frame.sceneVersion;
    }
    PathTraceResult result = path_trace::render(*integrator_, frame.camera, options_, frame.progress);
    context.extraRays = result.rays;
    for (const RenderedImage& image : images_)
        if (const FrameImage& target = context[image.port]; target.isRead && isRendered(image))
            upload(context.stream, pixelsOf(image, result), target.image);
    if (const NoisyIrradiance& noisy = context[noisy_]; noisy.isRead) {
        upload(context.stream, result.irradiance, noisy.irradiance);
        context.stream.upload(noisy.moments, result.moments);
    }
    ReferenceSums& sums = context[sums_];
    sums.final = std::move(result.totalSums);
    sums.indirect = std::move(result.indirectSums);
}

VOXRAY_REGISTER_PASS(PathTracePass);

}  // namespace voxray
