#include <array>
#include <string>

#include "base/error.h"
#include "graph/registry.h"
#include "passes/common/filter/noisy_irradiance.h"
#include "scene/camera_rays.h"

namespace voxray {
namespace {

constexpr uint32_t kMeanLevels = 3;  // Neighborhoods whose means are compared have hundreds of pixels.

}  // namespace

/// Light that is denoised.
enum class FilteredLight { Indirect, Direct };
template <>
struct EnumNames<FilteredLight> {
    static constexpr std::array names{std::pair{FilteredLight::Indirect, "indirect"},
                                      std::pair{FilteredLight::Direct, "direct"}};
};

/// Denoises a gather's irradiance. Source: the edge-avoiding à-trous wavelet of Dammertz et al. 2010, with a
/// weight that balances noise against bias: the gradient bound of Ward et al. 1988, geometry, and means of
/// neighborhoods (wavelet.comp). Docs: docs/filtering.md.
class FilterIrradiance final : public Pass {
 public:
    static constexpr const char* kName = "filter_irradiance";
    static constexpr const char* kFilterLabel = "filtered";
    static constexpr const char* kHelp =
        "Denoises a gather's irradiance along surfaces and multiplies by albedo. "
        "The noisy irradiance is that of a gather (gather_rays, path_trace), or with `light: direct` that of lamps "
        "and the environment (direct_shadow_rays). "
        "An edge-avoiding wavelet whose width follows from the number of rays and, where the gather writes moments, "
        "from their variance, the distances of their hits, and the differences of light between neighborhoods. "
        "Biased by: edge_stopping_scale and levels, less the more rays. Lambert surfaces only. "
        "Source: Dammertz et al. 2010; Ward et al. 1988; docs/filtering.md.";
    struct Params {
        FilteredLight light = FilteredLight::Indirect;
        uint32_t levels = 4;
        float edgeStoppingScale = 0.0f;
        static constexpr auto schema() {
            return std::tuple{field("light", &Params::light,
                                    "indirect: reads 'noisy_irradiance' and writes 'indirect'. "
                                    "direct: reads 'noisy_direct', adds 'unfiltered_direct' and writes 'direct'."),
                              field("levels", &Params::levels,
                                    "Levels of the wavelet, each with twice the radius of the previous one: "
                                    "n levels have a radius of 2^n - 1 pixels.",
                                    1u, 6u),
                              field("edge_stopping_scale", &Params::edgeStoppingScale,
                                    "Factor of the bound of the difference of irradiance between two texels. "
                                    "1: the whole bound, sharp and noisy; less: smoother, and shadows blur. "
                                    "0: 0.1 for indirect light, most of whose changes cancel; 1 for direct light, "
                                    "where the edge of a shadow is a single change.",
                                    0.0f, 100.0f)};
        }
    };

    explicit FilterIrradiance(const Params& params) : params_(params) {}
    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    /// Computes the statistics of light around each element.
    void findLight(PassContext& context) const;
    /// @return the mean irradiance of each element's neighborhood.
    const Image& computeMeans(PassContext& context) const;
    uint64_t elements() const;

    bool isDirect() const { return params_.light == FilteredLight::Direct; }
    float edgeStoppingScale() const {
        return params_.edgeStoppingScale > 0 ? params_.edgeStoppingScale : isDirect() ? 1.0f : 0.1f;
    }

    const Params params_;
    In<GBuffer> gbuffer_{*this, "gbuffer", "what the camera sees"};
    In<NoisyIrradiance> noisy_{*this, isDirect() ? "noisy_direct" : "noisy_irradiance",
                               "irradiance from few rays a texel"};
    InOptional<FrameImage> unfiltered_{*this, "unfiltered_direct", "added to the result", isDirect()};
    Out<FrameImage> result_{*this, isDirect() ? "direct" : "indirect", "radiance reflected of this light"};
    Kernel findSurfaces_{*this, "surfaces.comp"};
    Kernel statistics_{*this, "statistics.comp"};
    Kernel mean_{*this, "mean.comp"};
    Kernel findLight_{*this, "light.comp"};
    Kernel wavelet_{*this, "wavelet.comp"};
    Kernel resolve_{*this, "resolve.comp"};
    Buffer second_;           ///< Number of pixels with a second surface, then their indices.
    Buffer blockStatistics_;  ///< gpu::RayStatistics per block, from the gather's moments.
    // Images of elements (elements.glsl).
    Image surfaces_;     ///< surface.glsl
    Image reflectance_;  ///< Albedo times the surface's fraction of the pixel.
    Image means_[2];     ///< Means of neighborhoods (mean.comp), where the gather writes moments.
    Image light_;        ///< surface_light.glsl
    Image filtered_[2];  ///< Irradiance, W/m², and number of rays; read and written in turn by levels.
};

void FilterIrradiance::plan(PassPlan& plan) {
    const NoisyIrradiance& noisy = plan[noisy_];
    const uint32_t samples = plan[gbuffer_].samples;
    uint32_t minLevels = 1;
    while ((samples << minLevels) < 2 * noisy.spacing) ++minLevels;
    if (noisy.spacing > samples && params_.levels < minLevels)
        throw Error(
            "filter_irradiance: the gather has rays for one texel in each {0}x{0}, which {1} levels leave with gaps; "
            "raise 'levels' to {2} or the gather's rays",
            noisy.spacing, params_.levels, minLevels);
    plan[result_].lightBounces = noisy.lightBounces;
    plan.frameImage(result_);
    const glm::uvec3 extent{plan.frame.width, plan.frame.height * (samples > 1 ? 2 : 1), 1};
    const ImageDesc values{VK_FORMAT_R32G32B32A32_SFLOAT, extent};
    plan.image(surfaces_, "surfaces of pixels", {VK_FORMAT_R32G32B32A32_UINT, extent});
    plan.image(reflectance_, "reflectance of surfaces", {VK_FORMAT_R16G16B16A16_SFLOAT, extent});
    plan.image(light_, "statistics of light", values);
    for (Image& level : filtered_) plan.image(level, "filtered irradiance", values);
    plan.buffer(second_, "second surfaces", (1 + uint64_t(plan.frame.width) * plan.frame.height) * sizeof(uint32_t));
    if (noisy.blockSize > 0) {
        if (!noisy.hasStatistics)
            plan.buffer(blockStatistics_, "statistics of rays",
                        noisy.statisticsBytes(gbufferExtent(plan.frame, samples)));
        for (Image& mean : means_) plan.image(mean, "mean irradiance of neighborhoods", values);
    }

    Defines defines{{"SAMPLES", std::to_string(samples)}};
    if (noisy.blockSize > 0) defines.emplace("STATISTICS", "1");
    if (noisy.hasStatistics) defines.emplace("BOUNDED_GRADIENT", "1");
    for (Kernel* kernel : {&findSurfaces_, &statistics_, &mean_, &findLight_, &wavelet_, &resolve_})
        kernel->define(defines);
    statistics_.compileIf(noisy.blockSize > 0 && !noisy.hasStatistics);
    mean_.compileIf(noisy.blockSize > 0);
}

void FilterIrradiance::record(PassContext& context) {
    const glm::uvec2 pixels = context.frame.pixels();

    // Find the surfaces of each pixel
    context.stream.fill(second_, 0);
    context.dispatch(findSurfaces_, uint64_t(pixels.x) * pixels.y,
                     {context[gbuffer_],
                      {"irradiance", context[noisy_].irradiance},
                      {"surfaces", surfaces_},
                      {"source", filtered_[0]},
                      {"reflectance", reflectance_},
                      {"second", second_},
                      {"pixels", pixels}});

    // Filter their irradiance
    findLight(context);
    for (uint32_t level = 0; level < params_.levels; ++level)
        context.dispatch(wavelet_, elements(),
                         {{"second", second_},
                          {"surfaces", surfaces_},
                          {"light", light_},
                          {"source", filtered_[level % 2]},
                          {"result", filtered_[(level + 1) % 2]},
                          {"level", level},
                          {"edgeStoppingScale", edgeStoppingScale()}});

    // Compute the radiance that they reflect
    context.dispatch(resolve_, pixels,
                     {{"irradiance", filtered_[params_.levels % 2]},
                      {"reflectance", reflectance_},
                      {"unfiltered", context.orBlack(unfiltered_)},
                      {"result", context[result_].image}});
}

void FilterIrradiance::findLight(PassContext& context) const {
    const NoisyIrradiance& noisy = context[noisy_];
    const uint32_t samples = context[gbuffer_].samples;
    const CameraRays camera = cameraRays(context.frame.camera, context.frame.width, context.frame.height);
    glm::uvec2 blocks(0);
    const Image* mean = &means_[0];
    if (noisy.blockSize > 0) {
        blocks = noisy.blocks(gbufferExtent(context.frame, samples));
        if (!noisy.hasStatistics)
            context.dispatch(statistics_, blocks,
                             {{"moments", noisy.moments}, {"statistics", blockStatistics_}, {"blocks", blocks}});
        mean = &computeMeans(context);
    }
    context.dispatch(findLight_, elements(),
                     {{"second", second_},
                      {"surfaces", surfaces_},
                      {"light", light_},
                      ifUsed({"mean", *mean}),
                      ifUsed({"statistics", noisy.hasStatistics ? noisy.statistics : blockStatistics_}),
                      {"blocks", blocks},
                      {"blockSize", float(noisy.blockSize) / float(samples)},
                      {"pixelAngle", 2 * glm::length(camera.up) / float(context.frame.height)},
                      {"camera", camera.origin}});
}

const Image& FilterIrradiance::computeMeans(PassContext& context) const {
    const Image* source = &filtered_[0];
    for (uint32_t level = 0; level < kMeanLevels; ++level) {
        const Image& result = means_[level % 2];
        context.dispatch(
            mean_, elements(),
            {{"second", second_}, {"surfaces", surfaces_}, {"source", *source}, {"result", result}, {"level", level}});
        source = &result;
    }
    return *source;
}

uint64_t FilterIrradiance::elements() const {
    const glm::uvec3 extent = surfaces_.desc().extent;
    return uint64_t(extent.x) * extent.y;
}

VOXRAY_REGISTER_PASS(FilterIrradiance);

}  // namespace voxray
