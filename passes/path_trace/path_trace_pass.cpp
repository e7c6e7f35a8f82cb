#include "passes/path_trace/path_trace_pass.h"

#include <utility>

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
    const auto write = [&](const char* name, PathLight light, bool isHalf, const char* help,
                           const ImageF& (*pixels)(const PathTraceResult&)) {
        images_.push_back({builder.write<FrameImage>(name, help), name, light, pixels, isHalf});
    };
    using Result = PathTraceResult;
    write("final", PathLight::All, false, "radiance towards the camera",
          [](const Result& r) -> const ImageF& { return r.total; });
    write("indirect", PathLight::Indirect, false, "the part of it that was scattered more than once",
          [](const Result& r) -> const ImageF& { return r.indirect; });
    write("final_a", PathLight::All, true, "'final' of one half of the samples",
          [](const Result& r) -> const ImageF& { return r.totalHalves[0]; });
    write("final_b", PathLight::All, true, "'final' of the other half, independent of the first",
          [](const Result& r) -> const ImageF& { return r.totalHalves[1]; });
    write("indirect_a", PathLight::Indirect, true, "'indirect' of one half of the samples",
          [](const Result& r) -> const ImageF& { return r.indirectHalves[0]; });
    write("indirect_b", PathLight::Indirect, true, "'indirect' of the other half",
          [](const Result& r) -> const ImageF& { return r.indirectHalves[1]; });
    noisy_ = builder.write<NoisyIrradiance>("noisy_irradiance",
                                            "irradiance of indirect light, before the first hit reflects it");
    sums_ =
        builder.write<ReferenceSums>("sums", "sums over its samples by half, of which references are made");
}

void PathTracePass::plan(PassPlan& plan) {
    if (params_.light == PathLight::Indirect && plan.get(images_[0].port).isRead)
        throw Error("path_trace: with 'light: indirect' it writes no 'final'; let composite follow");
    options_ = {.width = plan.frame.width,
                .height = plan.frame.height,
                .spp = params_.spp,
                .bounces = params_.bounces,
                .light = params_.light,
                .samples = plan.frame.samples,
                .keepSums = plan.get(sums_).isRead && params_.light == PathLight::All && params_.spp > 1};
    uint64_t largest = 0;
    for (const RenderedImage& image : images_) {
        plan.get(image.port).lightBounces = params_.bounces;
        plan.get(image.port).hasSpecularLobes = true;
    }
    for (const RenderedImage& image : images_)
        if (FrameImage& frame = plan.get(image.port); frame.isRead && isRendered(image)) {
            plan.image(frame.image, image.name, frameImageDesc(plan.frame));
            largest = imageBytes(frameImageDesc(plan.frame));
        }
    if (NoisyIrradiance& noisy = plan.get(noisy_); noisy.isRead) {
        const uint32_t texels = plan.has(gbuffer_) ? plan.get(gbuffer_).samples : 1;
        options_.irradianceTexels = texels;
        noisy.lightBounces = params_.bounces;
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
    PathTraceResult result = pathTrace(*frame.scene, *embree_, frame.camera, options_, frame.progress);
    context.extraRays = result.rays;
    for (const RenderedImage& image : images_)
        if (const FrameImage& to = context.get(image.port); to.isRead && isRendered(image))
            upload(context.stream, image.pixels(result), to.image);
    if (const NoisyIrradiance& noisy = context.get(noisy_); noisy.isRead) {
        upload(context.stream, result.irradiance, noisy.irradiance);
        context.stream.upload(noisy.moments, result.moments);
    }
    ReferenceSums& sums = context.get(sums_);
    sums.final = std::move(result.totalSums);
    sums.indirect = std::move(result.indirectSums);
}

}  // namespace voxray
