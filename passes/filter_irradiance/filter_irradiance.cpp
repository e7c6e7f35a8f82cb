#include "passes/filter_irradiance/filter_irradiance.h"

#include <algorithm>

#include "base/error.h"
#include "passes/common/compute/dispatch.h"
#include "passes/common/view/camera_matrix.h"
#include "passes/common/view/frame_image.h"
#include "passes/filter_irradiance/filter_types.h"

namespace voxray {
namespace {

struct GuidePush {
    glm::uvec2 texels;
    glm::uvec2 blocks;
    uint32_t blockSize;
    float texelAngle;
    glm::vec3 camera;
};

struct WaveletPush {
    int32_t level;
    float edgeStoppingScale;
};

// Of the means that are compared: light from some hundreds of texels, of rays where each has one.
constexpr uint32_t kMeanLevels = 4;

}  // namespace

void FilterIrradiance::declare(PassBuilder& builder) {
    gbuffer_ = builder.read<GBuffer>("gbuffer", "what the camera sees");
    noisy_ = builder.read<NoisyIrradiance>("noisy_irradiance", "irradiance from few rays a texel");
    indirect_ = builder.write<FrameImage>("indirect", "radiance reflected of indirect light");
}

void FilterIrradiance::plan(PassPlan& plan) {
    const NoisyIrradiance& noisy = plan.get(noisy_);
    uint32_t minLevels = 1;
    while ((1u << minLevels) < 2 * noisy.spacing) ++minLevels;
    if (noisy.spacing > 1 && params_.levels < minLevels)
        throw Error(
            "filter_irradiance: the gather has rays for one texel in each {0}x{0}, which {1} levels leave "
            "with gaps; raise 'levels' to {2} or the gather's rays",
            noisy.spacing, params_.levels, minLevels);
    const uint32_t samples = plan.get(gbuffer_).samples;
    const glm::uvec2 texels = gbufferExtent(plan.frame, samples);
    plan.image(plan.get(indirect_).image, "filtered indirect", frameImageDesc(plan.frame));
    for (uint32_t i = 0; i < std::min(params_.levels, 2u); ++i)
        plan.image(filtered_[i], "filtered irradiance", NoisyIrradiance::desc(plan.frame, samples));
    plan.buffer(guides_, "guide of the filter", uint64_t(texels.x) * texels.y * sizeof(gpu::FilterTexel));
    if (noisy.blockSize > 0) {
        const glm::uvec2 blocks = noisy.blocks(texels);
        plan.buffer(blockStatistics_, "statistics of rays",
                    uint64_t(blocks.x) * blocks.y * sizeof(gpu::RayStatistics));
        for (Image& mean : means_)
            plan.image(mean, "mean irradiance of surroundings", NoisyIrradiance::desc(plan.frame, samples));
    }
}

void FilterIrradiance::prepare(PassSetup& setup) {
    const bool hasMoments = setup.get(noisy_).blockSize > 0;
    const auto program = [&](const char* file, const Defines& defines = {}) {
        return makeComputeProgram(setup.device, setup.compiler.compile(file, defines));
    };
    const Defines moments = hasMoments ? Defines{{"MOMENTS", "1"}} : Defines{};
    if (hasMoments) statistics_ = program("passes/filter_irradiance/statistics.comp");
    if (hasMoments) mean_ = program("passes/filter_irradiance/mean.comp");
    guide_ = program("passes/filter_irradiance/guide.comp", moments);
    wavelet_ = program("passes/filter_irradiance/wavelet.comp", moments);
    resolve_ = IrradianceResolve(setup);
    sampler_ = texelSampler(setup.device);
}

void FilterIrradiance::record(PassContext& context) {
    const GBuffer& gbuffer = context.get(gbuffer_);
    const NoisyIrradiance& noisy = context.get(noisy_);
    guide(context);
    const Image* mean = noisy.blockSize > 0 ? &means(context) : nullptr;
    const Image* from = &noisy.irradiance;
    for (uint32_t level = 0; level < params_.levels; ++level) {
        const Image& to = filtered_[level % 2];
        std::vector<Binding> bindings{{"guide", guides_}, {"source", *from, sampler_}, {"result", to}};
        if (mean) bindings.emplace_back("mean", *mean, sampler_);
        context.stream.dispatch(wavelet_, bindings, WaveletPush{int32_t(level), params_.edgeStoppingScale},
                                pixelGroups(to.desc().extent.x, to.desc().extent.y));
        from = &to;
    }
    resolve_.record(context, gbuffer, *from, context.get(indirect_).image);
}

const Image& FilterIrradiance::means(PassContext& context) const {
    const Image* from = &context.get(noisy_).irradiance;
    for (uint32_t level = 0; level < kMeanLevels; ++level) {
        const Image& to = means_[level % 2];
        context.stream.dispatch(mean_, {{"guide", guides_}, {"source", *from, sampler_}, {"result", to}},
                                int32_t(level), pixelGroups(to.desc().extent.x, to.desc().extent.y));
        from = &to;
    }
    return *from;
}

void FilterIrradiance::guide(PassContext& context) const {
    const GBuffer& gbuffer = context.get(gbuffer_);
    const NoisyIrradiance& noisy = context.get(noisy_);
    const glm::uvec2 texels = gbufferExtent(context.frame, gbuffer.samples);
    const CameraRays camera = cameraRays(context.frame.camera, texels.x, texels.y);
    GuidePush push{texels, glm::uvec2(0), noisy.blockSize, 2 * glm::length(camera.up) / float(texels.y),
                   camera.origin};
    std::vector<Binding> bindings{{"position", gbuffer.position, sampler_},
                                  {"normal", gbuffer.normal, sampler_},
                                  {"geometricNormal", gbuffer.geometricNormal, sampler_},
                                  {"guide", guides_}};
    if (noisy.blockSize > 0) {
        push.blocks = noisy.blocks(texels);
        context.stream.dispatch(statistics_, {{"moments", noisy.moments}, {"statistics", blockStatistics_}},
                                push.blocks, pixelGroups(push.blocks.x, push.blocks.y));
        bindings.emplace_back("statistics", blockStatistics_);
    }
    context.stream.dispatch(guide_, bindings, push, pixelGroups(texels.x, texels.y));
}

}  // namespace voxray
