#include <algorithm>

#include "graph/registry.h"
#include "passes/common/compute/random_seed.h"
#include "passes/common/view/gather_hits.h"
#include "passes/common/view/gbuffer.h"

namespace voxray {
namespace {

constexpr uint32_t kGatherBatchRays = 1u << 18;  // Bounds gather_rays' memory for a batch to 36 MiB.

}  // namespace

/// The rays of a hybrid final gather: rays find geometry, voxels hold the light at their hits. Tracing and
/// shading are separate passes, so that an injection can light only what the rays hit (inject_voxel_rays with
/// points: gather_hits). Source: Magalhães 2020, section 6.1 (rays for detail below a voxel); sampling: Ahmed
/// and Wonka 2020.
class TraceGatherRays final : public Pass {
 public:
    static constexpr const char* kName = "trace_gather_rays";
    static constexpr const char* kHelp =
        "Traces cosine-distributed gather rays from what the camera sees. gather_rays shades their hits. "
        "Exact geometry; noisy by: rays_per_block. "
        "Where a block has fewer rays than texels, filter_irradiance fills the texels without any.";
    struct Params {
        uint32_t raysPerBlock = 16;
        uint32_t block = 1;
        static constexpr auto schema() {
            return std::tuple{
                field("rays_per_block", &Params::raysPerBlock, "Rays from each block.", 1u, 65536u).lessNoise(),
                field("block", &Params::block, "Texels of the G-buffer along a block's edge.", powersOfTwo(1, 8))};
        }
    };

    explicit TraceGatherRays(const Params& params) : params_(params) {}
    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    const Params params_;
    In<GBuffer> gbuffer_{*this, "gbuffer", "what the camera sees"};
    Out<GatherHits> hits_{*this, "gather_hits", "where the gather rays hit"};
    Kernel generateRays_{*this, "generate_gather_rays.comp"};
    Buffer rays_;
};

void TraceGatherRays::plan(PassPlan& plan) {
    GatherHits& hits = plan[hits_];
    const glm::uvec2 texels = glm::uvec2(plan.frame.width, plan.frame.height) * plan[gbuffer_].samples;
    hits.layout = {texels, (texels + params_.block - 1u) / params_.block, params_.block, params_.raysPerBlock, 0};
    hits.blocksPerBatch = std::clamp(kGatherBatchRays / params_.raysPerBlock, 1u, hits.blocks());
    hits.batches = std::vector<Buffer>((hits.blocks() + hits.blocksPerBatch - 1) / hits.blocksPerBatch);
    for (uint32_t b = 0; b < hits.batches.size(); ++b)
        plan.buffer(hits.batches[b], "gather hits", uint64_t(hits.batchBlocks(b)) * params_.raysPerBlock * sizeof(Hit));
    plan.buffer(rays_, "gather rays", uint64_t(hits.blocksPerBatch) * params_.raysPerBlock * sizeof(Ray));
}

void TraceGatherRays::record(PassContext& context) {
    GatherHits& hits = context[hits_];
    hits.layout.seed = randomSeed(context.frame, context.frameIndex);
    for (uint32_t b = 0; b < hits.batches.size(); ++b) {
        const uint32_t blocks = hits.batchBlocks(b), rays = blocks * params_.raysPerBlock;
        context.dispatch(generateRays_, rays,
                         {context[gbuffer_],
                          {"rays", rays_},
                          {"layout", hits.layout},
                          {"firstBlock", b * hits.blocksPerBatch},
                          {"batchBlocks", blocks}});
        context.tracer.closestHit(context.stream, rays_, hits.batches[b], rays);
    }
}

VOXRAY_REGISTER_PASS(TraceGatherRays);

}  // namespace voxray
