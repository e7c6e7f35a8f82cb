#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "base/error.h"
#include "graph/registry.h"
#include "passes/common/filter/irradiance_resolve.h"
#include "passes/common/filter/noisy_irradiance.h"
#include "passes/common/view/gather_hits.h"
#include "passes/common/view/gbuffer.h"
#include "passes/final_gather/gather_rays/continued_paths.h"
#include "passes/final_gather/gather_rays/stored_light.h"

namespace voxray {

enum class DirectAtHits { Voxels, ShadowRays };

template <>
struct EnumNames<DirectAtHits> {
    static constexpr std::array names{std::pair{DirectAtHits::Voxels, "voxels"},
                                      std::pair{DirectAtHits::ShadowRays, "shadow_rays"}};
};

/// Indirect light by a final gather: rays find what each pixel sees, stored light tells how bright that is.
/// Source: Magalhães 2020 (hybrid of rays and voxels); NVIDIA's SHaRC (the cache's query). filter_irradiance
/// lowers its noise.
class GatherRays final : public Pass {
 public:
    static constexpr const char* kName = "gather_rays";
    static constexpr const char* kHelp =
        "Gathers indirect light by shading ray hits with stored light. "
        "The hits of trace_gather_rays take the irradiance that `source` holds there and their own albedo. "
        "Hits near the pixel and those without stored light are measured by paths, "
        "which bring a bounce more than is stored. Biased by: "
        "the size of voxels or of the cache's cells (light at the hits is as coarse as they are, "
        "not at the pixel; with `direct_at_hits: "
        "shadow_rays` only indirect light is) and merge_voxels' tolerance. "
        "Noisy by: rays_per_block, which filter_irradiance lowers; few samples in a cell of the cache. "
        "Lambert surfaces only. Reports how many hits find no light.";
    struct Params {
        GatherSource source = GatherSource::Voxels;
        DirectAtHits directAtHits = DirectAtHits::Voxels;
        uint32_t lightSamples = 1;
        float nearFieldCells = 2;
        uint32_t minSamples = 1;
        static constexpr auto schema() {
            return std::tuple{
                field("source", &Params::source,
                      "Where light is stored. voxels: in their faces, by any injection. "
                      "merged_voxels: in the trees of merge_voxels. "
                      "radiance_cache: in the hashed cells of update_radiance_cache."),
                field(
                    "direct_at_hits", &Params::directAtHits,
                    "Direct light at the hits. voxels: as coarse as voxels. shadow_rays: "
                    "exact, by a shadow ray from each hit to each light; voxels bring indirect light alone.")
                    .onlyWith(oneOf(&Params::source, {GatherSource::Voxels})),
                field("light_samples", &Params::lightSamples,
                      "Shadow rays to the emissive surfaces, and to the environment, "
                      "from each hit where direct light is measured.",
                      1u, 256u)
                    .onlyWith(oneOf(&Params::directAtHits, {DirectAtHits::ShadowRays}),
                              noneOf(&Params::nearFieldCells, {0.0f}),
                              oneOf(&Params::source, {GatherSource::MergedVoxels})),
                field("near_field_cells", &Params::nearFieldCells,
                      "A ray shorter than this many cells, or one that hits where no light is stored, "
                      "goes on as a path does instead of reading the cell there: "
                      "up to three times, over a radiance cache up to seven. "
                      "Cells are voxels, as they were before they were merged, or those of the cache. "
                      "0: every hit is read, and is black where no light is stored.",
                      0.0f, 64.0f),
                field("min_samples", &Params::minSamples,
                      "A cell with fewer samples counts as one without light: "
                      "a ray that hits there goes on. With a near_field_cells of 0 it is read all the same.",
                      1u, 65536u)
                    .onlyWith(oneOf(&Params::source, {GatherSource::RadianceCache}))};
        }
    };

    explicit GatherRays(const Params& params) : params_(params) {}
    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    /// Of a ray that goes on. In a cache without a cell rays become paths of eight bounces.
    static constexpr uint32_t kMaxSteps = 3, kMaxStepsOverCache = 7;
    static constexpr uint64_t kLightBytes = 4 * sizeof(float);  ///< Of a ray.

    bool isOverCache() const { return params_.source == GatherSource::RadianceCache; }
    /// Shades a batch of hits and adds up what the rays of each texel and of each block bring.
    ContinuedPaths::Counts gather(PassContext& context, const std::vector<Binding>& stored, uint32_t batch);

    const Params params_;
    StoredLight stored_{*this, params_.source, params_.directAtHits == DirectAtHits::Voxels,
                        params_.minSamples};
    In<GBuffer> gbuffer_{*this, "gbuffer", "what the camera sees"};
    In<GatherHits> hits_{*this, "gather_hits", "where the gather rays hit"};
    Out<NoisyIrradiance> noisy_{*this, "noisy_irradiance", "irradiance from few rays a texel"};
    Out<FrameImage> indirect_{*this, "indirect", "radiance reflected of indirect light, unfiltered"};
    Kernel shade_{*this, "shade.comp", stored_.defines()};
    Kernel averageTexels_{*this, "average_texels.comp"};
    Kernel sumMoments_{*this, "sum_moments.comp"};
    ContinuedPaths paths_{*this, stored_.defines()};
    std::optional<IrradianceResolve> resolve_;  ///< Where `indirect` is read.
    Buffer light_;                              ///< What the rays of a batch bring.
};

void GatherRays::plan(PassPlan& plan) {
    const GatherHits& hits = plan[hits_];
    const uint32_t texelsPerBlock = hits.layout.blockSize * hits.layout.blockSize;
    NoisyIrradiance& noisy = plan[noisy_];
    noisy.lightBounces = plan[indirect_].lightBounces = oneMoreBounce(stored_.bounces(plan));
    noisy.spacing = hits.layout.raysPerBlock < texelsPerBlock ? hits.layout.blockSize : 1;
    if (plan[indirect_].isRead && noisy.spacing > 1)
        throw Error(
            "{3}: blocks of {0}x{0} texels have {1} rays, which leaves texels without any; "
            "let filter_irradiance follow, or raise 'rays_per_block' of trace_gather_rays to {2}",
            hits.layout.blockSize, hits.layout.raysPerBlock, texelsPerBlock, kName);
    plan.image(noisy.irradiance, "noisy irradiance",
               NoisyIrradiance::desc(plan.frame, plan[gbuffer_].samples));
    sumMoments_.compileIf(noisy.isRead);
    if (noisy.isRead) {
        noisy.blockSize = hits.layout.blockSize;
        plan.buffer(noisy.moments, "moments of rays", noisy.momentsBytes(hits.layout.texels));
    }
    if (plan[indirect_].isRead) {
        plan.frameImage(indirect_);
        resolve_.emplace(*this);
    }

    const uint32_t rays = hits.blocksPerBatch * hits.layout.raysPerBlock;
    plan.buffer(light_, "light of gather rays", rays * kLightBytes);
    stored_.plan(plan);
    paths_.plan(plan,
                {.measureDirect = !stored_.holdsDirect(plan),
                 .lightSamples = params_.lightSamples,
                 .nearField = params_.nearFieldCells,
                 .maxSteps = isOverCache() ? kMaxStepsOverCache : kMaxSteps},
                stored_.constants(), rays);
    shade_.define(paths_.defines());
    shade_.specialize(stored_.constants());
}

void GatherRays::record(PassContext& context) {
    const std::vector<Binding> stored = stored_.bindings(context);
    double traced = 0, unlit = 0;
    for (uint32_t b = 0; b < context[hits_].batches.size(); ++b) {
        const ContinuedPaths::Counts counts = gather(context, stored, b);
        traced += double(context[hits_].batchBlocks(b)) * context[hits_].layout.raysPerBlock;
        traced += double(counts.rays);
        unlit += double(counts.unlit);
    }
    context.report(isOverCache() ? "hits without a cell, % of rays" : "hits on unlit faces, % of rays",
                   traced > 0 ? 100 * unlit / traced : 0);
    if (resolve_)
        resolve_->record(context, context[gbuffer_], context[noisy_].irradiance, context[indirect_].image);
}

ContinuedPaths::Counts GatherRays::gather(PassContext& context, const std::vector<Binding>& stored,
                                          uint32_t batch) {
    const GatherHits& hits = context[hits_];
    const uint32_t firstBlock = batch * hits.blocksPerBatch, blocks = hits.batchBlocks(batch);
    const uint32_t rays = blocks * hits.layout.raysPerBlock;
    const uint32_t texelsPerBlock = hits.layout.blockSize * hits.layout.blockSize;

    // Shade the hits with the irradiance that is stored there, and measure light where none is to be had.
    const std::vector<Binding> list = paths_.begin(context.stream);
    context.dispatch(shade_, rays,
                     {context.scene,
                      stored,
                      list,
                      context[gbuffer_],
                      {"hits", hits.batches[batch]},
                      {"light", light_},
                      {"layout", hits.layout},
                      {"firstBlock", firstBlock},
                      {"rays", rays},
                      {"nearField", params_.nearFieldCells}});
    const ContinuedPaths::Counts counts = paths_.follow(context, stored, light_);

    // Add up what the rays of each texel and of each block bring.
    const NoisyIrradiance& noisy = context[noisy_];
    context.dispatch(averageTexels_, uint64_t(blocks) * texelsPerBlock,
                     {{"light", light_},
                      {"gathered", noisy.irradiance},
                      {"layout", hits.layout},
                      {"firstBlock", firstBlock},
                      {"batchBlocks", blocks}});
    if (noisy.isRead)
        context.dispatch(sumMoments_, blocks,
                         {{"light", light_},
                          {"moments", noisy.moments},
                          {"firstBlock", firstBlock},
                          {"batchBlocks", blocks},
                          {"raysPerBlock", hits.layout.raysPerBlock}});
    return counts;
}

VOXRAY_REGISTER_PASS(GatherRays);

}  // namespace voxray
