#include <optional>
#include <vector>

#include "graph/registry.h"
#include "passes/common/filter/irradiance_resolve.h"
#include "passes/common/filter/noisy_irradiance.h"
#include "passes/common/view/gather_hits.h"
#include "passes/common/view/gather_light.h"
#include "passes/common/view/gbuffer.h"
#include "passes/final_gather/ray_sums/ray_sums.h"
#include "passes/final_gather/stored_light/continued_paths.h"
#include "passes/final_gather/stored_light/stored_light.h"

namespace voxray {

/// Indirect light by a final gather: the hits of gather rays are shaded by stored light. Source: Magalhães
/// 2020 (hybrid of rays and voxels); NVIDIA's SHaRC (lookups in the cache). filter_irradiance lowers its
/// noise.
class GatherRays final : public Pass {
 public:
    static constexpr const char* kName = "gather_rays";
    static constexpr const char* kHelp =
        "Gathers indirect light by shading ray hits with stored light. "
        "The hits of trace_gather_rays reflect the irradiance that `source` holds there by their albedo. "
        "From hits near the pixel and those without stored light paths continue, "
        "which add a bounce to what is stored. "
        "Biased by: the size of voxels or of the cache's cells (of light at the hits, not at the pixel; "
        "with `direct_at_hits: shadow_rays` of indirect light only) and merge_voxels' tolerance. "
        "Noisy by: rays_per_block, which filter_irradiance lowers; few samples in a cell of the cache. "
        "Lambert surfaces only, but for perfect mirrors that rays hit. Reports how many hits find no light.";
    using Params = StoredLightParams;

    explicit GatherRays(const Params& params) : params_(params) {}
    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    /// Shades a batch of hits and sums over the rays of each texel and of each block.
    ContinuedPaths::Counts gather(PassContext& context, const std::vector<Binding>& stored, uint32_t batch);
    void planLight(PassPlan& plan, uint32_t raysPerBatch);

    const Params params_;
    StoredLight stored_{*this, params_};
    In<GBuffer> gbuffer_{*this, "gbuffer", "what the camera sees"};
    In<GatherHits> hits_{*this, "gather_hits", "where the gather rays hit"};
    Out<NoisyIrradiance> noisy_{*this, "noisy_irradiance", "irradiance from few rays a texel"};
    Out<FrameImage> indirect_{*this, "indirect", "radiance reflected of indirect light, unfiltered"};
    Out<GatherLight> rayLight_{*this, "gather_light", "what each gather ray brings"};
    Kernel shadeHits_{*this, "shade_hits.comp", stored_.defines()};
    RaySums sums_{*this};
    ContinuedPaths paths_{*this, stored_.defines()};
    std::optional<IrradianceResolve> resolve_;  ///< Where `indirect` is read.
    Buffer light_;                              ///< As GatherLight::light, of a batch; where that is not read.
};

void GatherRays::plan(PassPlan& plan) {
    const GatherHits& hits = plan[hits_];
    NoisyIrradiance& noisy = plan[noisy_];
    noisy.lightBounces = plan[indirect_].lightBounces = oneMoreBounce(stored_.bounces(plan));
    if (plan[indirect_].isRead) RaySums::requireRays(hits, kName);
    sums_.plan(plan, hits, plan[gbuffer_].samples, noisy);
    if (plan[indirect_].isRead) {
        plan.frameImage(indirect_);
        resolve_.emplace(*this);
    }

    const uint32_t rays = hits.blocksPerBatch * hits.layout.raysPerBlock;
    planLight(plan, rays);
    paths_.plan(plan, params_, !stored_.holdsDirect(plan), rays);
    Defines defines = paths_.defines();
    if (plan[rayLight_].isRead) defines.emplace("NEAR_DISTANCES", "1");
    shadeHits_.define(defines);
}

void GatherRays::planLight(PassPlan& plan, uint32_t raysPerBatch) {
    GatherLight& result = plan[rayLight_];
    result.lightBounces = plan[noisy_].lightBounces;
    if (!result.isRead) {
        plan.buffer(light_, "light of gather rays", raysPerBatch * sizeof(glm::vec4));
        return;
    }
    const GatherHits& hits = plan[hits_];
    result.light = std::vector<Buffer>(hits.batches.size());
    result.nearDistances = std::vector<Buffer>(hits.batches.size());
    for (uint32_t b = 0; b < hits.batches.size(); ++b) {
        const uint64_t rays = uint64_t(hits.batchBlocks(b)) * hits.layout.raysPerBlock;
        plan.buffer(result.light[b], "light of gather rays", rays * sizeof(glm::vec4));
        plan.buffer(result.nearDistances[b], "near distances of gather rays", rays * sizeof(float));
    }
}

void GatherRays::record(PassContext& context) {
    const std::vector<Binding> stored = stored_.update(context);
    double traced = 0, unlit = 0;
    for (uint32_t b = 0; b < context[hits_].batches.size(); ++b) {
        const ContinuedPaths::Counts counts = gather(context, stored, b);
        traced += double(context[hits_].batchBlocks(b)) * context[hits_].layout.raysPerBlock;
        traced += double(counts.rays);
        unlit += double(counts.unlit);
    }
    context.report(stored_.unlitName(), traced > 0 ? 100 * unlit / traced : 0);
    if (resolve_) resolve_->record(context, context[gbuffer_], context[noisy_].irradiance, context[indirect_].image);
}

ContinuedPaths::Counts GatherRays::gather(PassContext& context, const std::vector<Binding>& stored, uint32_t batch) {
    const GatherHits& hits = context[hits_];
    const uint32_t firstBlock = batch * hits.blocksPerBatch;
    const uint32_t rays = hits.batchBlocks(batch) * hits.layout.raysPerBlock;
    const GatherLight& kept = context[rayLight_];
    const Buffer& light = kept.isRead ? kept.light[batch] : light_;
    const Buffer& nearDistances = kept.isRead ? kept.nearDistances[batch] : light_;

    // Shade the hits by stored light, and trace paths where it does not suffice
    const std::vector<Binding> hitList = paths_.clearHits(context.stream);
    context.dispatch(shadeHits_, rays,
                     {context.scene,
                      stored,
                      hitList,
                      context[gbuffer_],
                      {"hits", hits.batches[batch]},
                      {"light", light},
                      ifUsed({"nearDistances", nearDistances}),
                      {"layout", hits.layout},
                      {"firstBlock", firstBlock},
                      {"rays", rays},
                      {"nearField", params_.nearFieldCells}});
    const ContinuedPaths::Counts counts = paths_.trace(context, stored, light);

    sums_.add(context, hits, batch, light, context[noisy_]);
    return counts;
}

VOXRAY_REGISTER_PASS(GatherRays);

}  // namespace voxray
