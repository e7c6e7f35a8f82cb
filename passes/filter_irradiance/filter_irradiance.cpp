#include "passes/filter_irradiance/filter_irradiance.h"

#include <algorithm>

#include "base/error.h"
#include "passes/common/compute/dispatch.h"
#include "passes/common/view/camera_matrix.h"
#include "passes/common/view/frame_image.h"
#include "passes/filter_irradiance/filter_types.h"

namespace voxray {
namespace {

struct LightPush {
    glm::uvec2 blocks;
    float blockSize;
    float pixelAngle;
    glm::vec3 camera;
};

struct WaveletPush {
    int32_t level;
    float edgeStoppingScale;
};

// Of the means that are compared: light from some hundreds of pixels, of rays where each has one.
constexpr uint32_t kMeanLevels = 3;

/// Of an image of elements (elements.glsl).
ImageDesc elementsDesc(const Frame& frame, uint32_t samples, VkFormat format) {
    ImageDesc desc;
    desc.format = format;
    desc.extent = {frame.width, frame.height * (samples > 1 ? 2 : 1), 1};
    return desc;
}

}  // namespace

void FilterIrradiance::declare(PassBuilder& builder) {
    gbuffer_ = builder.read<GBuffer>("gbuffer", "what the camera sees");
    noisy_ = builder.read<NoisyIrradiance>("noisy_irradiance", "irradiance from few rays a texel");
    indirect_ = builder.write<FrameImage>("indirect", "radiance reflected of indirect light");
}

void FilterIrradiance::plan(PassPlan& plan) {
    const NoisyIrradiance& noisy = plan.get(noisy_);
    const uint32_t samples = plan.get(gbuffer_).samples;
    uint32_t minLevels = 1;
    while ((samples << minLevels) < 2 * noisy.spacing) ++minLevels;
    if (noisy.spacing > samples && params_.levels < minLevels)
        throw Error(
            "filter_irradiance: the gather has rays for one texel in each {0}x{0}, which {1} levels leave "
            "with gaps; raise 'levels' to {2} or the gather's rays",
            noisy.spacing, params_.levels, minLevels);
    plan.get(indirect_).lightBounces = noisy.lightBounces;
    plan.image(plan.get(indirect_).image, "filtered indirect", frameImageDesc(plan.frame));
    const ImageDesc values = elementsDesc(plan.frame, samples, VK_FORMAT_R32G32B32A32_SFLOAT);
    plan.image(surfaces_, "surfaces of pixels",
               elementsDesc(plan.frame, samples, VK_FORMAT_R32G32B32A32_UINT));
    plan.image(reflectance_, "reflectance of surfaces",
               elementsDesc(plan.frame, samples, VK_FORMAT_R16G16B16A16_SFLOAT));
    plan.image(light_, "light around surfaces", values);
    for (Image& level : filtered_) plan.image(level, "filtered irradiance", values);
    plan.buffer(second_, "second surfaces",
                (1 + uint64_t(plan.frame.width) * plan.frame.height) * sizeof(uint32_t));
    if (noisy.blockSize > 0) {
        const glm::uvec2 blocks = noisy.blocks(gbufferExtent(plan.frame, samples));
        plan.buffer(blockStatistics_, "statistics of rays",
                    uint64_t(blocks.x) * blocks.y * sizeof(gpu::RayStatistics));
        for (Image& mean : means_) plan.image(mean, "mean irradiance of surroundings", values);
    }
}

void FilterIrradiance::prepare(PassSetup& setup) {
    const bool hasMoments = setup.get(noisy_).blockSize > 0;
    Defines defines{{"SAMPLES", std::to_string(setup.get(gbuffer_).samples)}};
    if (hasMoments) defines.emplace("MOMENTS", "1");
    const auto program = [&](const std::string& file) {
        return makeComputeProgram(setup.device,
                                  setup.compiler.compile("passes/filter_irradiance/" + file, defines));
    };
    findSurfaces_ = program("surfaces.comp");
    if (hasMoments) statistics_ = program("statistics.comp");
    if (hasMoments) mean_ = program("mean.comp");
    findLight_ = program("light.comp");
    wavelet_ = program("wavelet.comp");
    resolve_ = program("resolve.comp");
    sampler_ = texelSampler(setup.device);
}

void FilterIrradiance::record(PassContext& context) {
    const GBuffer& gbuffer = context.get(gbuffer_);
    const glm::uvec2 pixels{context.frame.width, context.frame.height};
    CommandStream& stream = context.stream;

    // The surfaces of each pixel.
    stream.fill(second_, 0);
    stream.dispatch(findSurfaces_,
                    {{"position", gbuffer.position, sampler_},
                     {"normal", gbuffer.normal, sampler_},
                     {"geometricNormal", gbuffer.geometricNormal, sampler_},
                     {"albedo", gbuffer.albedo, sampler_},
                     {"irradiance", context.get(noisy_).irradiance, sampler_},
                     {"surfaces", surfaces_},
                     {"source", filtered_[0]},
                     {"reflectance", reflectance_},
                     {"second", second_}},
                    pixels, linearGroups(uint64_t(pixels.x) * pixels.y));

    // Their light, filtered.
    findLight(context);
    for (uint32_t level = 0; level < params_.levels; ++level)
        stream.dispatch(wavelet_,
                        {{"second", second_},
                         {"surfaces", surfaces_, sampler_},
                         {"light", light_, sampler_},
                         {"source", filtered_[level % 2], sampler_},
                         {"result", filtered_[(level + 1) % 2]}},
                        WaveletPush{int32_t(level), params_.edgeStoppingScale}, elementGroups());

    // What they reflect.
    stream.dispatch(resolve_,
                    {{"irradiance", filtered_[params_.levels % 2], sampler_},
                     {"reflectance", reflectance_, sampler_},
                     {"result", context.get(indirect_).image}},
                    {}, pixelGroups(pixels.x, pixels.y));
}

void FilterIrradiance::findLight(PassContext& context) const {
    const NoisyIrradiance& noisy = context.get(noisy_);
    const uint32_t samples = context.get(gbuffer_).samples;
    const CameraRays camera = cameraRays(context.frame.camera, context.frame.width, context.frame.height);
    LightPush push{glm::uvec2(0), float(noisy.blockSize) / float(samples),
                   2 * glm::length(camera.up) / float(context.frame.height), camera.origin};
    std::vector<Binding> bindings{{"second", second_}, {"surfaces", surfaces_, sampler_}, {"light", light_}};
    if (noisy.blockSize > 0) {
        push.blocks = noisy.blocks(gbufferExtent(context.frame, samples));
        context.stream.dispatch(statistics_, {{"moments", noisy.moments}, {"statistics", blockStatistics_}},
                                push.blocks, pixelGroups(push.blocks.x, push.blocks.y));
        bindings.emplace_back("mean", means(context), sampler_);
        bindings.emplace_back("statistics", blockStatistics_);
    }
    context.stream.dispatch(findLight_, bindings, push, elementGroups());
}

const Image& FilterIrradiance::means(PassContext& context) const {
    const Image* from = &filtered_[0];
    for (uint32_t level = 0; level < kMeanLevels; ++level) {
        const Image& to = means_[level % 2];
        context.stream.dispatch(mean_,
                                {{"second", second_},
                                 {"surfaces", surfaces_, sampler_},
                                 {"source", *from, sampler_},
                                 {"result", to}},
                                int32_t(level), elementGroups());
        from = &to;
    }
    return *from;
}

glm::uvec3 FilterIrradiance::elementGroups() const {
    const glm::uvec3 elements = surfaces_.desc().extent;
    return linearGroups(uint64_t(elements.x) * elements.y);
}

}  // namespace voxray
