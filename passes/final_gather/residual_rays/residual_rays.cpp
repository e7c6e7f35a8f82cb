#include <algorithm>
#include <optional>
#include <vector>

#include "graph/registry.h"
#include "passes/common/filter/irradiance_resolve.h"
#include "passes/common/view/gather_light.h"
#include "passes/final_gather/ray_sums/ray_sums.h"
#include "passes/path_trace/path_streams/path_streams.h"
#include "passes/path_trace/sobol.h"

namespace voxray {
namespace {

constexpr uint32_t kPathSequence = 0x52657369u;  ///< Of the paths' random numbers.

/// Sum over blocks of the variance of a ray within its block times the block's rays.
double variance(const std::vector<gpu::RayMoments>& blocks) {
    double sum = 0;
    for (const gpu::RayMoments& b : blocks)
        if (b.rays > 0) sum += std::max(double(b.squared) - double(b.luminance) * b.luminance / b.rays, 0.0);
    return sum;
}

}  // namespace

/// Stored light as a control variate of paths. Source: Dereviannykh et al. 2025 (Neural Incident Radiance Cache:
/// two-level Monte Carlo), Giles 2008 (multilevel Monte Carlo). Docs: docs/residual-rays.md.
class ResidualRays final : public Pass {
 public:
    static constexpr const char* kName = "residual_rays";
    static constexpr const char* kHelp =
        "Measures by paths what stored light lacks at the hits of gather rays. "
        "With `probability` a gather ray goes on as a path, and brings (path - stored) / probability beside what "
        "gather_rays found, so that the mean of both is that of path tracing whatever is stored. "
        "Unbiased for its number of bounces, on Lambert receivers; noisy by: probability, rays_per_block. "
        "`noisy_residual` may be negative; filter_irradiance with 'light: residual' filters it apart. "
        "Source: Dereviannykh et al. 2025; Giles 2008.";
    struct Params {
        float probability = 0.25f;
        uint32_t bounces = 8;
        static constexpr auto schema() {
            return std::tuple{
                field("probability", &Params::probability, "Part of the gather rays that go on as paths.", 1e-3f, 1.0f)
                    .lessNoise(),
                field("bounces", &Params::bounces,
                      "Scattering events of paths after direct light at what the camera sees, as path_trace counts "
                      "them: the image has as many, whatever is stored.",
                      1u, 1024u)};
        }
    };

    explicit ResidualRays(const Params& params) : params_(params) {}
    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    /// Traces the paths of a batch, weighs them, and sums what its rays bring over texels and blocks.
    void measure(PassContext& context, uint32_t batch);
    void reportPaths(PassContext& context);

    const Params params_;
    In<GBuffer> gbuffer_{*this, "gbuffer", "what the camera sees"};
    In<GatherHits> hits_{*this, "gather_hits", "where the gather rays hit"};
    In<GatherLight> light_{*this, "gather_light", "what they bring of stored light"};
    Out<NoisyIrradiance> noisy_{*this, "noisy_residual", "irradiance that stored light lacks, of few rays a texel"};
    Out<FrameImage> indirect_{*this, "indirect", "radiance reflected of stored light and residual, unfiltered"};
    PathStreams streams_{*this};
    Kernel beginPaths_{*this, "begin_paths.comp"}, weigh_{*this, "weigh_residuals.comp"};
    RaySums sums_{*this};
    std::optional<IrradianceResolve> resolve_;  ///< Where `indirect` is read.
    Image irradiance_;                          ///< Of stored light and residual; there.
    Buffer residuals_, totals_;                 ///< Of a batch, as GatherLight::light.
    Buffer storedMoments_;                      ///< Of stored light, as NoisyIrradiance::moments.
    Buffer chosen_;                             ///< Number of paths.
};

void ResidualRays::plan(PassPlan& plan) {
    const GatherHits& hits = plan[hits_];
    const uint32_t samples = plan[gbuffer_].samples;
    NoisyIrradiance& noisy = plan[noisy_];
    noisy.lightBounces = plan[indirect_].lightBounces = params_.bounces;
    sums_.plan(plan, hits, samples, noisy, true);
    plan.buffer(storedMoments_, "moments of stored light", noisy.momentsBytes(hits.layout.texels));
    if (plan[indirect_].isRead) {
        RaySums::requireRays(hits, kName);
        plan.frameImage(indirect_);
        plan.image(irradiance_, "irradiance with residual", NoisyIrradiance::desc(plan.frame, samples));
        resolve_.emplace(*this);
    }

    const uint32_t batchRays = hits.blocksPerBatch * hits.layout.raysPerBlock;
    streams_.plan(plan, {.bounces = params_.bounces, .light = PathLight::Indirect, .irradianceTexels = samples},
                  batchRays);
    plan.scratchBuffer(residuals_, "residuals", batchRays * sizeof(glm::vec4));
    plan.scratchBuffer(totals_, "light with residuals", batchRays * sizeof(glm::vec4));
    plan.buffer(chosen_, "number of paths", sizeof(uint32_t));
}

void ResidualRays::record(PassContext& context) {
    streams_.begin(context);
    context.stream.fill(chosen_, 0);
    for (uint32_t b = 0; b < context[hits_].batches.size(); ++b) measure(context, b);
    if (resolve_) resolve_->record(context, context[gbuffer_], irradiance_, context[indirect_].image);
    reportPaths(context);
}

void ResidualRays::measure(PassContext& context, uint32_t batch) {
    const GatherHits& hits = context[hits_];
    const gpu::GatherLayout& layout = hits.layout;
    const uint32_t firstBlock = batch * hits.blocksPerBatch, blocks = hits.batchBlocks(batch);
    const uint32_t rays = blocks * layout.raysPerBlock;
    const Bindings common{{"hits", hits.batches[batch]},
                          {"layout", layout},
                          {"firstBlock", firstBlock},
                          {"rays", rays},
                          {"probability", params_.probability}};
    context.dispatch(beginPaths_, rays, {common.all(), context[gbuffer_], streams_.open(context), {"chosen", chosen_}});

    // A block's rays have one sequence of random numbers
    streams_.follow(context, {.firstPixel = firstBlock,
                              .pixels = blocks,
                              .firstSample = 0,
                              .samples = layout.raysPerBlock,
                              .width = layout.blocks.x * PATH_TILE,
                              .height = layout.blocks.y * PATH_TILE,
                              .halves = 1,
                              .pointsOfPixel = 0,
                              .seed = path_trace::hashOf(layout.seed, kPathSequence)});
    const Buffer& light = context[light_].light[batch];
    context.dispatch(
        weigh_, rays,
        {common.all(), {"light", light}, {"sums", streams_.sums()}, {"residuals", residuals_}, {"totals", totals_}});

    const NoisyIrradiance& noisy = context[noisy_];
    sums_.average(context, hits, batch, residuals_, noisy.irradiance);
    sums_.addMoments(context, hits, batch, residuals_, noisy.moments);
    sums_.addMoments(context, hits, batch, light, storedMoments_);
    if (resolve_) sums_.average(context, hits, batch, totals_, irradiance_);
}

void ResidualRays::reportPaths(PassContext& context) {
    // The rays to the paths' first hits are those of trace_gather_rays
    const uint32_t paths = context.stream.readAs<uint32_t>(chosen_, 1)[0];
    context.extraRays = streams_.rays(context) - paths;
    const GatherHits& hits = context[hits_];
    context.report("paths, % of gather rays", 100.0 * paths / (double(hits.blocks()) * hits.layout.raysPerBlock));
    const auto varianceOf = [&](const Buffer& moments) {
        return variance(context.stream.readAs<gpu::RayMoments>(moments, moments.bytes() / sizeof(gpu::RayMoments)));
    };
    const double residual = varianceOf(context[noisy_].moments), stored = varianceOf(storedMoments_);
    context.report("residual's part of the rays' variance, %",
                   residual > 0 ? 100 * residual / (residual + stored) : 0.0);
}

VOXRAY_REGISTER_PASS(ResidualRays);

}  // namespace voxray
