#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "graph/registry.h"
#include "passes/common/compute/random_seed.h"
#include "passes/common/filter/irradiance_resolve.h"
#include "passes/common/filter/noisy_irradiance.h"
#include "passes/final_gather/gather_screen_probes/screen_probes.h"
#include "passes/final_gather/stored_light/continued_paths.h"
#include "passes/final_gather/stored_light/stored_light.h"

namespace voxray {
namespace {

constexpr uint32_t kProbeBatchRays = 1u << 17;  // Bounds the memory of a batch of rays.

}  // namespace

/// A final gather from probes in screen space. Source: Wright et al. 2022 (Lumen: adaptive placement, importance from
/// the previous frame, filter in probe space, interpolation by planes); Boissé et al. 2023 (GI-1.0: screen probes over
/// a hashed cache). Docs: docs/screen-probes.md.
class GatherScreenProbes final : public Pass {
 public:
    static constexpr const char* kName = "gather_screen_probes";
    static constexpr const char* kHelp =
        "Gathers indirect light by rays from screen probes. "
        "Probes stand on what the camera sees, one in each tile of pixels and more where a tile shows several surfaces; "
        "`source` lights the hits of their rays, a filter averages probes by direction, and pixels interpolate. "
        "Biased by: spacing (light is smooth between probes), filter_passes, "
        "the size of voxels or of the cache's cells. Noisy by: rays_per_probe; noise is as wide as probes are apart. "
        "Lambert surfaces only. Source: Wright et al. 2022 (Lumen); Boissé et al. 2023 (GI-1.0); "
        "docs/screen-probes.md.";
    struct Params : StoredLightParams {
        uint32_t spacing = 8;
        uint32_t raysPerProbe = 64;
        uint32_t extraProbes = 3;
        uint32_t filterPasses = 3;
        float importance = 0.5f;
        uint32_t directions = 8;
        static constexpr auto schema() {
            return std::tuple_cat(
                std::tuple{
                    field("spacing", &Params::spacing, "Pixels along a tile's edge; each tile has a probe.",
                          powersOfTwo(1, 32)),
                    field("rays_per_probe", &Params::raysPerProbe, "Rays from each probe.", 1u, 4096u).lessNoise(),
                    field("extra_probes", &Params::extraProbes,
                          "Most further probes of a tile, on surfaces on which there is no probe near.", 0u, 15u),
                    field("filter_passes", &Params::filterPasses,
                          "Averages over the probes around, by direction: each reaches a tile farther. 0: no filter.",
                          0u, 8u),
                    field("importance", &Params::importance,
                          "Part of a probe's rays that go where light came from in the frames before; "
                          "the others are distributed by cosine.",
                          0.0f, 0.9f),
                    field("directions", &Params::directions,
                          "Bins of directions along an edge of a probe's octahedral map.", powersOfTwo(2, 16))},
                StoredLightParams::schema());
        }
    };

    explicit GatherScreenProbes(const Params& params) : params_(params) {}
    uint32_t warmupFrames() const override { return isGuided() ? 1 : 0; }
    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    bool isGuided() const { return params_.importance > 0; }
    /// Of a probe's rays. At least one is by cosine, as guided rays alone would never find light where none was.
    uint32_t guidedRays() const {
        const auto rounded = uint32_t(std::lround(params_.importance * float(params_.raysPerProbe)));
        return std::min(rounded, params_.raysPerProbe - 1);
    }
    uint32_t bins() const { return params_.directions * params_.directions; }
    Defines historyDefine() const { return isGuided() ? Defines{{"HAS_HISTORY", "1"}} : Defines{}; }
    uint32_t batchProbes() const;
    void planBuffers(PassPlan& plan);
    /// Makes the buffers whose size follows from the number of probes.
    void makeRoom(Device& device);
    /// Traces and shades the rays of probes [first, first + count) and sums them by direction.
    ContinuedPaths::Counts gather(PassContext& context, const std::vector<Binding>& stored, uint32_t first,
                                  uint32_t count);
    void filter(PassContext& context);
    void interpolate(PassContext& context);

    const Params params_;
    StoredLight stored_{*this, params_};
    In<GBuffer> gbuffer_{*this, "gbuffer", "what the camera sees"};
    In<SurfaceMotion> motion_{*this, "motion", "motion since the previous frame", isGuided()};
    Out<NoisyIrradiance> noisy_{*this, "noisy_irradiance", "irradiance between probes"};
    Out<FrameImage> indirect_{*this, "indirect", "radiance reflected of indirect light"};
    ScreenProbes probes_{*this, {params_.spacing, params_.extraProbes, isGuided()}};
    Kernel guide_{*this, "guide_rays.comp"};
    Kernel generateRays_{*this, "generate_probe_rays.comp", historyDefine()};
    Kernel shade_{*this, "shade_probe_rays.comp", stored_.defines()};
    Kernel binRays_{*this, "bin_rays.comp"};
    Kernel sumNeighbors_{*this, "sum_neighbors.comp"};
    Kernel filterBins_{*this, "filter_bins.comp"};
    Kernel sumBins_{*this, "sum_bins.comp", historyDefine()};
    Kernel interpolate_{*this, "interpolate_probes.comp"};
    ContinuedPaths paths_{*this, stored_.defines()};
    std::optional<IrradianceResolve> resolve_;  ///< Where `indirect` is read.
    Buffer rays_, hits_, weights_, light_;      ///< Of a batch.
    Buffer counts_;
    // Of all probes, while the pass records
    std::array<LargeBuffer, 2> bins_;  ///< Read and written in turn by the filter.
    LargeBuffer distribution_;
    Buffer weightSums_, irradiance_;
    // Of all probes
    std::array<LargeBuffer, 2> importance_;  ///< Of this frame, and of the previous one.
};

uint32_t GatherScreenProbes::batchProbes() const {
    return std::min(std::max(kProbeBatchRays / params_.raysPerProbe, 1u), probes_.capacity());
}

void GatherScreenProbes::plan(PassPlan& plan) {
    const uint32_t samples = plan[gbuffer_].samples;
    NoisyIrradiance& noisy = plan[noisy_];
    noisy.lightBounces = plan[indirect_].lightBounces = oneMoreBounce(stored_.bounces(plan));
    plan.image(noisy.irradiance, "irradiance between probes", NoisyIrradiance::desc(plan.frame, samples));
    if (plan[indirect_].isRead) {
        plan.frameImage(indirect_);
        resolve_.emplace(*this);
    }
    probes_.plan(plan, samples);
    planBuffers(plan);

    guide_.compileIf(isGuided());
    filterBins_.compileIf(params_.filterPasses > 0);
    sumNeighbors_.compileIf(params_.filterPasses > 0);
    for (Kernel* kernel : {&guide_, &generateRays_, &binRays_, &filterBins_, &sumBins_})
        kernel->specialize({{"kBinEdge", params_.directions}});
    shade_.define(paths_.defines());
}

void GatherScreenProbes::planBuffers(PassPlan& plan) {
    const uint32_t rays = batchProbes() * params_.raysPerProbe;
    plan.scratchBuffer(rays_, "probe rays", uint64_t(rays) * sizeof(Ray));
    plan.scratchBuffer(hits_, "probe rays' hits", uint64_t(rays) * sizeof(Hit));
    plan.scratchBuffer(weights_, "weights of probe rays", uint64_t(rays) * sizeof(float));
    plan.scratchBuffer(light_, "light of probe rays", uint64_t(rays) * sizeof(glm::vec4));
    paths_.plan(plan, params_, !stored_.holdsDirect(plan), rays);

    plan.scratchBuffer(counts_, "counts of texels", 2 * sizeof(uint32_t));
    // What goes with the number of probes is made once that is known; about one probe a tile
    const uint64_t binBytes =
        (params_.filterPasses > 0 ? 2 : 1) * sizeof(glm::vec4) + (isGuided() ? 3 : 0) * sizeof(float);
    plan.estimate(double(probes_.tileCount()) * double(bins() * binBytes + sizeof(gpu::ProbeIrradiance)));
}

void GatherScreenProbes::makeRoom(Device& device) {
    const uint64_t probes = probes_.reservedCount(), allBins = probes * bins();
    bins_[0] = LargeBuffer(device, "light of probes by direction", allBins * sizeof(glm::vec4));
    if (params_.filterPasses > 0) {
        bins_[1] = LargeBuffer(device, "filtered light of probes", allBins * sizeof(glm::vec4));
        weightSums_ = Buffer(device, "sums of filter weights", probes * sizeof(float));
    }
    irradiance_ = Buffer(device, "irradiance of probes", probes * sizeof(gpu::ProbeIrradiance));
    if (!isGuided()) return;
    const uint64_t importanceBytes = probes * (bins() + 1) * sizeof(float);
    distribution_ = LargeBuffer(device, "distributions of probe rays", importanceBytes);
    std::swap(importance_[0], importance_[1]);
    growTo(importance_[0], device, "importance of directions", importanceBytes);
}

void GatherScreenProbes::record(PassContext& context) {
    const SurfaceMotion* motion = isGuided() ? &context[motion_] : nullptr;
    probes_.place(context, context[gbuffer_], motion);
    makeRoom(context.device);
    if (motion)
        context.dispatch(guide_, probes_.count(),
                         {probes_,
                          {"motion", motion->motion},
                          {"previous", motion->previous},
                          {"OldImportanceRef", importance_[probes_.hasLast() ? 1 : 0].ref()},
                          {"DistributionRef", distribution_.ref()},
                          {"count", probes_.count()},
                          {"hasHistory", probes_.hasLast()}});

    const std::vector<Binding> stored = stored_.update(context);
    double traced = double(probes_.count()) * params_.raysPerProbe, unlit = 0;
    for (uint32_t first = 0; first < probes_.count(); first += batchProbes()) {
        const ContinuedPaths::Counts counts =
            gather(context, stored, first, std::min(batchProbes(), probes_.count() - first));
        traced += double(counts.rays);
        unlit += double(counts.unlit);
    }
    context.report("probes per tile", double(probes_.count()) / probes_.tileCount());
    context.report(stored_.unlitName(), traced > 0 ? 100 * unlit / traced : 0);
    filter(context);
    interpolate(context);
}

ContinuedPaths::Counts GatherScreenProbes::gather(PassContext& context, const std::vector<Binding>& stored,
                                                  uint32_t first, uint32_t count) {
    const uint32_t rays = count * params_.raysPerProbe;
    const Bindings common{{"rays", rays_}, {"rayCount", rays}};
    context.dispatch(generateRays_, rays,
                     {probes_,
                      common.all(),
                      ifUsed({"DistributionRef", distribution_.ref()}),
                      {"weights", weights_},
                      {"firstProbe", first},
                      {"raysPerProbe", params_.raysPerProbe},
                      {"guidedRays", guidedRays()},
                      {"seed", randomSeed(context.frame, context.frameIndex)}});
    context.tracer.closestHit(context.stream, rays_, hits_, rays);

    const std::vector<Binding> hitList = paths_.clearHits(context.stream);
    context.dispatch(shade_, rays,
                     {context.scene,
                      stored,
                      hitList,
                      common.all(),
                      {"hits", hits_},
                      {"light", light_},
                      {"firstRay", first * params_.raysPerProbe},
                      {"nearField", params_.nearFieldCells}});
    const ContinuedPaths::Counts counts = paths_.trace(context, stored, light_);
    context.dispatch(binRays_, count,
                     {{"rays", rays_},
                      {"hits", hits_},
                      {"weights", weights_},
                      {"light", light_},
                      {"BinsRef", bins_[0].ref()},
                      {"firstProbe", first},
                      {"count", count},
                      {"raysPerProbe", params_.raysPerProbe}});
    return counts;
}

void GatherScreenProbes::filter(PassContext& context) {
    if (params_.filterPasses > 0)
        context.dispatch(sumNeighbors_, probes_.count(),
                         {probes_, {"weightSums", weightSums_}, {"count", probes_.count()}});
    for (uint32_t pass = 0; pass < params_.filterPasses; ++pass)
        context.dispatch(filterBins_, uint64_t(probes_.count()) * bins(),
                         {probes_,
                          {"weightSums", weightSums_},
                          {"BinsRef", bins_[pass % 2].ref()},
                          {"FilteredRef", bins_[1 - pass % 2].ref()},
                          {"count", probes_.count()}});
    context.dispatch(sumBins_, probes_.count(),
                     {probes_,
                      {"BinsRef", bins_[params_.filterPasses % 2].ref()},
                      {"irradiance", irradiance_},
                      ifUsed({"DistributionRef", distribution_.ref()}),
                      ifUsed({"ImportanceRef", importance_[0].ref()}),
                      {"count", probes_.count()}});
}

void GatherScreenProbes::interpolate(PassContext& context) {
    const NoisyIrradiance& noisy = context[noisy_];
    context.stream.fill(counts_, 0);
    context.dispatch(interpolate_, noisy.irradiance.desc().extent,
                     {context[gbuffer_],
                      probes_,
                      {"irradiance", irradiance_},
                      {"counts", counts_},
                      {"result", noisy.irradiance},
                      {"raysPerProbe", params_.raysPerProbe}});
    const std::vector<uint32_t> counts = context.stream.readAs<uint32_t>(counts_, 2);
    context.report("texels without a probe of their surface, %", counts[0] > 0 ? 100.0 * counts[1] / counts[0] : 0);
    bins_ = {};
    weightSums_ = {};
    irradiance_ = {};
    distribution_ = {};
    if (resolve_) resolve_->record(context, context[gbuffer_], noisy.irradiance, context[indirect_].image);
}

VOXRAY_REGISTER_PASS(GatherScreenProbes);

}  // namespace voxray
