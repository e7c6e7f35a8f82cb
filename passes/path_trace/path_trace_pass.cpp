#include "passes/path_trace/path_trace_pass.h"

#include "base/error.h"
#include "passes/common/view/frame_image.h"

namespace voxray {
namespace {

/// Uploads an image of 3 or 4 channels; the fourth is 1 where there is none.
void upload(CommandStream& stream, const ImageF& from, const Image& to) {
    std::vector<float> rgba(from.pixelCount() * 4, 1.0f);
    for (size_t i = 0; i < from.pixelCount(); ++i)
        for (size_t c = 0; c < from.channels; ++c) rgba[4 * i + c] = from.data[from.channels * i + c];
    stream.upload(to, std::as_bytes(std::span(rgba)));
    stream.finish();
}

}  // namespace

void PathTracePass::declare(PassBuilder& builder) {
    gbuffer_ =
        builder.readOptional<GBuffer>("gbuffer", "whose texels 'noisy_irradiance' is for; else pixels");
    final_ = builder.write<FrameImage>("final", "radiance towards the camera");
    indirect_ = builder.write<FrameImage>("indirect", "the part of it that was scattered more than once");
    variance_ = builder.write<FrameImage>("variance", "variance of each pixel's mean in 'final'");
    indirectVariance_ =
        builder.write<FrameImage>("indirect_variance", "variance of each pixel's mean in 'indirect'");
    noisy_ = builder.write<NoisyIrradiance>("noisy_irradiance",
                                            "irradiance of indirect light, before the first hit reflects it");
}

void PathTracePass::plan(PassPlan& plan) {
    if (params_.light == PathLight::Indirect && plan.get(final_).isRead)
        throw Error("path_trace: with 'light: indirect' it writes no 'final'; let composite follow");
    options_ = {.width = plan.frame.width,
                .height = plan.frame.height,
                .spp = params_.spp,
                .bounces = params_.bounces,
                .light = params_.light};
    uint64_t largest = 0;
    for (const auto& [port, image] : frameImages())
        if (FrameImage& frame = plan.get(port); frame.isRead) {
            plan.image(frame.image, image.name, frameImageDesc(plan.frame));
            largest = imageBytes(frameImageDesc(plan.frame));
        }
    if (NoisyIrradiance& noisy = plan.get(noisy_); noisy.isRead) {
        const uint32_t texels = plan.has(gbuffer_) ? plan.get(gbuffer_).samples : 1;
        options_.irradianceTexels = texels;
        noisy.spacing = texels;
        noisy.blockSize = texels * options_.momentsPixels();
        const ImageDesc desc = NoisyIrradiance::desc(plan.frame, texels);
        plan.image(noisy.irradiance, "path traced irradiance", desc);
        plan.buffer(noisy.moments, "moments of paths", noisy.momentsBytes(gbufferExtent(plan.frame, texels)));
        largest = imageBytes(desc);
    }
    plan.reserveScratch("staging of an image", largest);
}

void PathTracePass::prepare(PassSetup& setup) {
    embree_ = std::make_unique<EmbreeScene>(*setup.frame.scene);
}

void PathTracePass::record(PassContext& context) {
    const Frame& frame = context.frame;
    options_.seed = frame.seed + context.frameIndex;
    context.stream.finish();
    if (frame.changed && !frame.changed->empty()) embree_->update();
    const PathTraceResult result = pathTrace(*frame.scene, *embree_, frame.camera, options_, frame.progress);
    context.extraRays = result.rays;
    for (const auto& [port, image] : frameImages())
        if (const FrameImage& to = context.get(port); to.isRead)
            upload(context.stream, result.*image.pixels, to.image);
    if (const NoisyIrradiance& noisy = context.get(noisy_); noisy.isRead) {
        upload(context.stream, result.irradiance, noisy.irradiance);
        context.stream.upload(noisy.moments, result.moments);
    }
}

std::vector<std::pair<Port<FrameImage>, PathTracePass::RenderedImage>> PathTracePass::frameImages() const {
    std::vector<std::pair<Port<FrameImage>, RenderedImage>> images{
        {indirect_, {"path traced indirect", &PathTraceResult::indirect}},
        {indirectVariance_, {"path traced indirect variance", &PathTraceResult::indirectVariance}}};
    if (params_.light == PathLight::Indirect) return images;
    images.push_back({final_, {"path traced", &PathTraceResult::total}});
    images.push_back({variance_, {"path traced variance", &PathTraceResult::totalVariance}});
    return images;
}

}  // namespace voxray
