#include "passes/path_trace/path_trace_pass.h"

#include "passes/common/view/frame_image.h"
#include "passes/path_trace/path_tracer.h"

namespace voxray {
namespace {

void upload(CommandStream& stream, const ImageF& from, const Image& to) {
    std::vector<float> rgba(from.pixelCount() * 4, 1.0f);
    for (size_t i = 0; i < from.pixelCount(); ++i)
        for (size_t c = 0; c < 3; ++c) rgba[4 * i + c] = from.data[3 * i + c];
    stream.upload(to, std::as_bytes(std::span(rgba)));
    stream.finish();
}

}  // namespace

void PathTracePass::declare(PassBuilder& builder) {
    final_ = builder.write<FrameImage>("final", "radiance towards the camera");
    indirect_ = builder.write<FrameImage>("indirect", "the part of it that was scattered more than once");
    variance_ = builder.write<FrameImage>("variance", "variance of each pixel's mean in 'final'");
    indirectVariance_ =
        builder.write<FrameImage>("indirect_variance", "variance of each pixel's mean in 'indirect'");
}

void PathTracePass::plan(PassPlan& plan) {
    const ImageDesc desc = frameImageDesc(plan.frame);
    plan.image(plan.get(final_).image, "path traced", desc);
    plan.image(plan.get(indirect_).image, "path traced indirect", desc);
    plan.image(plan.get(variance_).image, "path traced variance", desc);
    plan.image(plan.get(indirectVariance_).image, "path traced indirect variance", desc);
    plan.reserveScratch("staging of an image", imageBytes(desc));
}

void PathTracePass::prepare(PassSetup& setup) {
    embree_ = std::make_unique<EmbreeScene>(*setup.frame.scene);
}

void PathTracePass::record(PassContext& context) {
    const Frame& frame = context.frame;
    const PathTraceOptions options{frame.width, frame.height, params_.spp, params_.bounces,
                                   frame.seed + context.frameIndex};
    context.stream.finish();
    if (frame.changed && !frame.changed->empty()) embree_->update();
    const PathTraceResult result = pathTrace(*frame.scene, *embree_, frame.camera, options, frame.progress);
    context.extraRays = result.rays;
    upload(context.stream, result.total, context.get(final_).image);
    upload(context.stream, result.indirect, context.get(indirect_).image);
    upload(context.stream, result.totalVariance, context.get(variance_).image);
    upload(context.stream, result.indirectVariance, context.get(indirectVariance_).image);
}

}  // namespace voxray
