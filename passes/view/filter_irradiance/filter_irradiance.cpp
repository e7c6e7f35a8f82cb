#include <algorithm>
#include <string>

#include "base/error.h"
#include "graph/registry.h"
#include "passes/common/compute/large_buffer.h"
#include "passes/common/filter/noisy_irradiance.h"
#include "passes/common/filter/wavelet_noise.h"
#include "passes/view/filter_irradiance/filter_irradiance_params.h"
#include "passes/view/filter_irradiance/level_kernel.h"
#include "passes/view/scene_materials.h"
#include "scene/camera_rays.h"

namespace voxray {
namespace {

constexpr uint32_t kMeanLevels = 3;  // Neighborhoods whose means are compared have hundreds of pixels.
constexpr uint32_t kResidualLevels = 6;
constexpr uint32_t kTile = 16;  // TILE of tiles.glsl.
constexpr uint32_t kTileBytes = 6 * sizeof(float), kRaisedBytes = 3 * sizeof(float), kNoiseBytes = 2 * sizeof(float);
constexpr uint32_t kMeasuredLevels = 3;  // MEASURED_LEVELS of noise_ratio.glsl.

/// Whether albedo or normal may change within the surfaces of a material.
bool varies(const Material& m) {
    return (textureKinds(m) & (BASE_COLOR_TEXTURES | METALLIC_ROUGHNESS_TEXTURES | NORMAL_TEXTURES)) != 0;
}

glm::uvec2 tilesOf(glm::uvec2 pixels) {
    return (pixels + kTile - 1u) / kTile;
}

}  // namespace

/// Denoises a gather's irradiance. Source: the edge-avoiding à-trous wavelet of Dammertz et al. 2010, with a
/// weight that balances noise against bias: the gradient bound of Ward et al. 1988, geometry, and means of
/// neighborhoods (wavelet.comp); optionally linear regression on position (Moon et al. 2014). Docs: docs/filtering.md.
class FilterIrradiance final : public Pass {
 public:
    static constexpr const char* kName = "filter_irradiance";
    static constexpr const char* kFilterLabel = "filtered";
    static constexpr const char* kHelp =
        "Denoises a gather's irradiance along surfaces and multiplies by albedo. "
        "The noisy irradiance is that of a gather (gather_rays, path_trace), or with `light: direct` that of lamps "
        "and the environment (direct_shadow_rays), or with `light: residual` what stored light lacks (residual_rays). "
        "An edge-avoiding wavelet whose width follows from the number of rays and, where the gather writes moments, "
        "from their variance, the distances of their hits, and the differences of light between neighborhoods. "
        "Biased by: edge_stopping_scale and levels, less the more rays. Lambert surfaces only. "
        "Source: Dammertz et al. 2010; Ward et al. 1988; Moon et al. 2014; docs/filtering.md.";
    using Params = FilterIrradianceParams;

    explicit FilterIrradiance(const Params& params) : params_(params) {}
    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    /// Bounds outliers by the statistics of rays of blocks.
    void boundOutliers(PassContext& context) const;
    /// Finds by how much the light of tiles is raised, so that the filter keeps it. @param filtered irradiance.
    void keepLight(PassContext& context, const LargeBuffer& filtered) const;
    /// Measures the noise of a level's input over that of independent rays.
    void measureNoise(PassContext& context, uint32_t level) const;
    /// Computes the statistics of light around each element.
    void findLight(PassContext& context) const;
    /// Computes the mean irradiance of neighborhoods that are twice as wide as the last ones. @param level from 0 on.
    void widenMeans(PassContext& context, uint32_t level) const;
    glm::uvec2 blocks(PassContext& context) const;
    float blockPixels(PassContext& context) const;

    bool hasSeveral(PassContext& context) const { return context[gbuffer_].samples > 1; }
    bool isDirect() const { return params_.light == FilteredLight::Direct; }
    bool isResidual() const { return params_.light == FilteredLight::Residual; }
    bool hasRegression() const { return params_.estimator == Estimator::Regression && !isResidual(); }
    bool boundsOutliers() const { return hasRegression() || isResidual(); }
    uint32_t levels() const {
        if (params_.levels > 0) return params_.levels;
        return isResidual() ? kResidualLevels : hasRegression() ? 5 : WAVELET_LEVELS;
    }
    const char* noisyName() const {
        return isDirect() ? "noisy_direct" : isResidual() ? "noisy_residual" : "noisy_irradiance";
    }
    float edgeStoppingScale() const {
        if (params_.edgeStoppingScale > 0) return params_.edgeStoppingScale;
        return isDirect() ? 1.0f : hasRegression() ? 0.02f : 0.1f;
    }

    const Params params_;
    In<GBuffer> gbuffer_{*this, "gbuffer", "what the camera sees"};
    In<NoisyIrradiance> noisy_{*this, noisyName(), "irradiance from few rays a texel"};
    InOptional<FrameImage> unfiltered_{*this, isResidual() ? "indirect" : "unfiltered_direct", "added to the result",
                                       isDirect() || isResidual()};
    Out<FrameImage> result_{*this, isDirect() ? "direct" : "indirect", "radiance reflected of this light"};
    Kernel findSurfaces_{*this, "surfaces.comp"};
    Kernel findSeveral_{*this, "surfaces.comp", {{"LISTED", "1"}}};
    Kernel statistics_{*this, "statistics.comp"};
    Kernel bound_{*this, "bound.comp"};
    Kernel giveBack_{*this, "give_back.comp"};
    Kernel keepLight_{*this, "keep_light.comp"};
    Kernel sumColumns_{*this, "sum_columns.comp"};
    Kernel noise_{*this, "noise.comp"};
    Kernel findNoiseRatio_{*this, "noise_ratio.comp"};
    LevelKernel mean_{*this, "mean.comp"};
    Kernel findLight_{*this, "light.comp"};
    Kernel findSecondLight_{*this, "light.comp", {{"LISTED", "1"}}};
    Kernel widerMeans_{*this, "wider_means.comp"};
    LevelKernel wavelet_{*this, "wavelet.comp"};
    Kernel resolve_{*this, "resolve.comp"};
    Buffer several_;  ///< Pixels with several surfaces, or not covered by one (shaders/compute/indirect_list.glsl).
    Buffer blockStatistics_;  ///< gpu::RayStatistics per block, from the gather's moments.
    // Of light that is given back
    Buffer columns_;  ///< TileLight per column of pixels of a tile (keep_light.comp).
    Buffer tiles_;    ///< TileLight per tile (tiles.glsl).
    Buffer raised_;   ///< Factor of each tile's irradiance (give_back.comp).
    // Regression, where the gather writes moments.
    Buffer blockMeans_;  ///< Luminance per block, W/m².
    Buffer noiseSums_;   ///< NoiseSums per tile (noise_ratio.glsl).
    Buffer noiseRatio_;  ///< By level (noise_ratio.comp).
    // Arrays of elements (elements.glsl).
    LargeBuffer surfaces_;     ///< surface.glsl
    LargeBuffer reflectance_;  ///< Albedo times the surface's fraction of the pixel.
    LargeBuffer own_;          ///< What elements reflect of their own irradiance (surfaces.comp); not of residuals.
    LargeBuffer means_[2];     ///< mean.glsl, written and read in turn by levels; where rays' variance is known.
    LargeBuffer light_;        ///< surface_light.glsl
    LargeBuffer filtered_[2];  ///< Irradiance, W/m², and number of rays; read and written in turn by levels.
    LargeBuffer weights_;      ///< Of second surfaces and the first ones around them (level.glsl), of one level.
};

void FilterIrradiance::plan(PassPlan& plan) {
    const NoisyIrradiance& noisy = plan[noisy_];
    const uint32_t samples = plan[gbuffer_].samples;
    uint32_t minLevels = 1;
    while ((samples << minLevels) < 2 * noisy.spacing) ++minLevels;
    if (noisy.spacing > samples && levels() < minLevels)
        throw Error(
            "filter_irradiance: the gather has rays for one texel in each {0}x{0}, which {1} levels leave with gaps; "
            "raise 'levels' to {2} or the gather's rays",
            noisy.spacing, levels(), minLevels);
    if (isResidual() && !plan[unfiltered_])
        throw Error(
            "filter_irradiance: with 'light: residual' it adds to 'indirect', which no pass before it writes; "
            "put a filter_irradiance of stored light there");
    plan[result_].lightBounces = noisy.lightBounces;
    plan.frameImage(result_);
    const uint64_t words = sizeof(uint64_t) * plan.frame.width * plan.frame.height * (samples > 1 ? 2 : 1);
    plan.buffer(surfaces_, "surfaces of pixels", 3 * words);
    plan.buffer(reflectance_, "reflectance of surfaces", words);
    plan.buffer(light_, "statistics of light", words);
    for (LargeBuffer& level : filtered_) plan.buffer(level, "filtered irradiance", 2 * words);
    if (samples > 1)
        plan.buffer(weights_, "weights of second surfaces", 9 * sizeof(float) * plan.frame.width * plan.frame.height);
    plan.buffer(several_, "pixels with several surfaces",
                (4 + uint64_t(plan.frame.width) * plan.frame.height) * sizeof(uint32_t));
    const bool hasMoments = noisy.blockSize > 0 && !noisy.hasStatistics;
    const bool givesBack = hasMoments && boundsOutliers(), measuresNoise = hasMoments && hasRegression();
    const glm::uvec2 texels = gbufferExtent(plan.frame, samples);
    if (hasMoments) plan.buffer(blockStatistics_, "statistics of rays", noisy.statisticsBytes(texels));
    if (!isResidual()) {
        plan.buffer(own_, "light of own rays", 2 * words);
        plan.buffer(columns_, "light of columns",
                    uint64_t(plan.frame.width) * tilesOf(plan.frame.pixels()).y * kTileBytes);
    }
    if (givesBack) {
        const glm::uvec2 blocks = noisy.blocks(texels);
        plan.buffer(blockMeans_, "mean light of rays", uint64_t(blocks.x) * blocks.y * sizeof(float));
    }
    if (givesBack || !isResidual()) {
        const glm::uvec2 tiles = tilesOf(plan.frame.pixels());
        plan.buffer(tiles_, "light of tiles", uint64_t(tiles.x) * tiles.y * kTileBytes);
        plan.buffer(raised_, "light given back", uint64_t(tiles.x) * tiles.y * kRaisedBytes);
    }
    if (measuresNoise) {
        const glm::uvec2 tiles = tilesOf(plan.frame.pixels());
        plan.buffer(noiseSums_, "noise of tiles", uint64_t(tiles.x) * tiles.y * kNoiseBytes);
        plan.buffer(noiseRatio_, "noise ratio", kMeasuredLevels * sizeof(float));
    }
    if (noisy.blockSize > 0)
        for (LargeBuffer& mean : means_) plan.buffer(mean, "mean irradiance of neighborhoods", words);

    Defines defines{{"SAMPLES", std::to_string(samples)}};
    if (noisy.blockSize > 0) defines.emplace("STATISTICS", "1");
    if (noisy.hasStatistics) defines.emplace("BOUNDED_GRADIENT", "1");
    if (isResidual()) defines.emplace("SIGNED", "1");
    if (hasRegression()) defines.emplace("REGRESSION", "1");
    if (givesBack || !isResidual()) defines.emplace("GIVE_BACK", "1");
    if (!isResidual()) defines.emplace("KEEPS_LIGHT", "1");
    if (std::ranges::any_of(plan.frame.scene->scene->materials, varies)) defines.emplace("ALBEDO_VARIES", "1");
    if (givesBack) defines.emplace("BOUNDS_OUTLIERS", "1");
    if (measuresNoise) defines.emplace("NOISE_RATIO", "1");
    if (samples > 1 && boundsOutliers()) defines.emplace("READS_ALL_SECOND", "1");
    for (Kernel* kernel : {&findSurfaces_, &findSeveral_, &statistics_, &bound_, &giveBack_, &keepLight_, &sumColumns_,
                           &noise_, &findNoiseRatio_, &findLight_, &findSecondLight_, &widerMeans_, &resolve_})
        kernel->define(defines);
    for (Kernel* kernel : {&findSeveral_, &findSecondLight_}) kernel->compileIf(samples > 1);
    statistics_.compileIf(hasMoments);
    bound_.compileIf(givesBack);
    giveBack_.compileIf(givesBack || !isResidual());
    for (Kernel* kernel : {&keepLight_, &sumColumns_}) kernel->compileIf(!isResidual());
    for (Kernel* kernel : {&noise_, &findNoiseRatio_}) kernel->compileIf(measuresNoise);
    mean_.define(defines, noisy.blockSize > 0, samples > 1);
    wavelet_.define(defines, true, samples > 1);
    widerMeans_.compileIf(noisy.blockSize > 0 && hasRegression());
}

void FilterIrradiance::record(PassContext& context) {
    const glm::uvec2 pixels = context.frame.pixels();

    // Find the surfaces of each pixel
    context.stream.fill(several_, 1);
    const Bindings surfaces{context[gbuffer_],
                            {"irradiance", context[noisy_].irradiance},
                            {"SurfacesRef", surfaces_.ref()},
                            {"SourceRef", filtered_[0].ref()},
                            ifUsed({"MeansRef", means_[1].ref()}),
                            {"ReflectanceRef", reflectance_.ref()},
                            ifUsed({"OwnRef", own_.ref()}),
                            {"indirectList", several_},
                            {"pixels", pixels}};
    context.dispatch(findSurfaces_, pixels, surfaces);
    if (hasSeveral(context)) dispatchIndirect(context.stream, findSeveral_, several_, 0, surfaces);

    // Find the light around each
    const NoisyIrradiance& noisy = context[noisy_];
    const bool hasMeans = noisy.blockSize > 0, hasMoments = hasMeans && !noisy.hasStatistics;
    if (hasMoments)
        context.dispatch(statistics_, blocks(context),
                         {{"moments", noisy.moments},
                          {"statistics", blockStatistics_},
                          ifUsed({"blockMeans", blockMeans_}),
                          {"blocks", blocks(context)}});
    if (hasMoments && boundsOutliers()) boundOutliers(context);
    for (uint32_t level = 0; hasMeans && level < kMeanLevels; ++level) widenMeans(context, level);
    findLight(context);

    // Filter their irradiance. With regression compare means of neighborhoods as wide as a level's reach from the
    // fourth on
    for (uint32_t level = 0; level < levels(); ++level) {
        if (hasMeans && hasRegression() && level >= kMeanLevels) {
            widenMeans(context, level);
            context.dispatch(widerMeans_, glm::uvec2(pixels.x, pixels.y * (hasSeveral(context) ? 2 : 1)),
                             {{"SurfacesRef", surfaces_.ref()},
                              {"MeansRef", means_[level % 2].ref()},
                              {"LightRef", light_.ref()},
                              {"pixels", pixels}});
        }
        if (hasMoments && hasRegression() && level < kMeasuredLevels) measureNoise(context, level);
        wavelet_.record(context, level,
                        {{"SurfacesRef", surfaces_.ref()},
                         {"LightRef", light_.ref()},
                         {"SourceRef", filtered_[level % 2].ref()},
                         {"ResultRef", filtered_[(level + 1) % 2].ref()},
                         ifUsed({"noiseRatio", noiseRatio_}),
                         {"edgeStoppingScale", edgeStoppingScale()},
                         ifUsed({"ratioLevel", std::min(level, kMeasuredLevels - 1)})},
                        several_, weights_.ref());
    }

    // Compute the radiance that they reflect
    const LargeBuffer& filtered = filtered_[levels() % 2];
    if (!isResidual()) keepLight(context, filtered);
    context.dispatch(resolve_, pixels,
                     {{"IrradianceRef", filtered.ref()},
                      {"ReflectanceRef", reflectance_.ref()},
                      {"unfiltered", context.orBlack(unfiltered_)},
                      ifUsed({"raised", raised_}),
                      {"result", context[result_].image}});
}

void FilterIrradiance::boundOutliers(PassContext& context) const {
    const glm::uvec2 pixels = context.frame.pixels(), tiles = tilesOf(pixels);
    context.dispatch(bound_, pixels,
                     {{"SurfacesRef", surfaces_.ref()},
                      {"SourceRef", filtered_[0].ref()},
                      {"MeansRef", means_[1].ref()},
                      {"statistics", blockStatistics_},
                      {"blockMeans", blockMeans_},
                      ifUsed({"tiles", tiles_}),
                      {"pixels", pixels},
                      {"blocks", blocks(context)},
                      {"blockSize", blockPixels(context)}});
    if (isResidual())
        context.dispatch(giveBack_, tiles, {{"tiles", tiles_}, {"raised", raised_}, {"tileCount", tiles}});
}

void FilterIrradiance::keepLight(PassContext& context, const LargeBuffer& filtered) const {
    const glm::uvec2 pixels = context.frame.pixels(), tiles = tilesOf(pixels);
    context.dispatch(keepLight_, glm::uvec2(pixels.x, tiles.y),
                     {{"IrradianceRef", filtered.ref()},
                      {"ReflectanceRef", reflectance_.ref()},
                      {"OwnRef", own_.ref()},
                      {"columns", columns_},
                      {"pixels", pixels}});
    context.dispatch(sumColumns_, tiles, {{"columns", columns_}, {"tiles", tiles_}, {"pixels", pixels}});
    context.dispatch(giveBack_, tiles, {{"tiles", tiles_}, {"raised", raised_}, {"tileCount", tiles}});
}

void FilterIrradiance::measureNoise(PassContext& context, uint32_t level) const {
    const glm::uvec2 pixels = context.frame.pixels(), tiles = tilesOf(pixels);
    context.dispatch(noise_, pixels,
                     {{"SurfacesRef", surfaces_.ref()},
                      {"LightRef", light_.ref()},
                      {"SourceRef", filtered_[level % 2].ref()},
                      {"noise", noiseSums_},
                      {"pixels", pixels},
                      {"level", level}});
    context.dispatch(
        findNoiseRatio_, uint64_t(1),
        {{"noise", noiseSums_}, {"noiseRatio", noiseRatio_}, {"tiles", tiles.x * tiles.y}, {"level", level}});
}

void FilterIrradiance::findLight(PassContext& context) const {
    const NoisyIrradiance& noisy = context[noisy_];
    const CameraRays camera = cameraRays(context.frame.camera, context.frame.width, context.frame.height);
    const Bindings bindings{{"SurfacesRef", surfaces_.ref()},
                            {"LightRef", light_.ref()},
                            ifUsed({"MeansRef", means_[(kMeanLevels - 1) % 2].ref()}),
                            {"pixels", context.frame.pixels()},
                            ifUsed({"statistics", noisy.hasStatistics ? noisy.statistics : blockStatistics_}),
                            ifUsed({"indirectList", several_}),
                            {"blocks", blocks(context)},
                            {"blockSize", blockPixels(context)},
                            {"pixelAngle", 2 * glm::length(camera.up) / float(context.frame.height)},
                            {"camera", camera.origin}};
    context.dispatch(findLight_, context.frame.pixels(), bindings);
    if (hasSeveral(context)) dispatchIndirect(context.stream, findSecondLight_, several_, 0, bindings);
}

void FilterIrradiance::widenMeans(PassContext& context, uint32_t level) const {
    mean_.record(context, level,
                 {{"SurfacesRef", surfaces_.ref()},
                  {"SourceRef", means_[(level + 1) % 2].ref()},
                  {"ResultRef", means_[level % 2].ref()}},
                 several_, weights_.ref());
}

glm::uvec2 FilterIrradiance::blocks(PassContext& context) const {
    const NoisyIrradiance& noisy = context[noisy_];
    return noisy.blockSize > 0 ? noisy.blocks(gbufferExtent(context.frame, context[gbuffer_].samples)) : glm::uvec2(0);
}

float FilterIrradiance::blockPixels(PassContext& context) const {
    return float(context[noisy_].blockSize) / float(context[gbuffer_].samples);
}

VOXRAY_REGISTER_PASS(FilterIrradiance);

}  // namespace voxray
