#include "passes/trace_gather_rays/trace_gather_rays.h"

#include <algorithm>

#include "base/error.h"
#include "passes/common/compute/dispatch.h"
#include "passes/common/compute/random_seed.h"
#include "passes/common/view/frame_image.h"

namespace voxray {
namespace {

constexpr uint32_t kGatherBatchRays = 1u << 18;  // Bounds what gather_rays needs for a batch to 36 MiB.

struct GatherEmitPush {
    gpu::GatherLayout layout;
    uint32_t firstBlock;
    uint32_t batchBlocks;
};

}  // namespace

void TraceGatherRays::declare(PassBuilder& builder) {
    gbuffer_ = builder.read<GBuffer>("gbuffer", "what the camera sees");
    hits_ = builder.write<GatherHits>("gather_hits", "where the gather rays hit");
}

void TraceGatherRays::plan(PassPlan& plan) {
    GatherHits& hits = plan.get(hits_);
    const glm::uvec2 texels = glm::uvec2(plan.frame.width, plan.frame.height) * plan.get(gbuffer_).samples;
    hits.layout = {texels, (texels + params_.block - 1u) / params_.block, params_.block, params_.raysPerBlock,
                   0};
    hits.blocksPerBatch = std::clamp(kGatherBatchRays / params_.raysPerBlock, 1u, hits.blocks());
    hits.batches = std::vector<Buffer>((hits.blocks() + hits.blocksPerBatch - 1) / hits.blocksPerBatch);
    for (uint32_t b = 0; b < hits.batches.size(); ++b)
        plan.buffer(hits.batches[b], "gather hits",
                    uint64_t(hits.batchBlocks(b)) * params_.raysPerBlock * sizeof(Hit));
    plan.buffer(rays_, "gather rays", uint64_t(hits.blocksPerBatch) * params_.raysPerBlock * sizeof(Ray));
}

void TraceGatherRays::prepare(PassSetup& setup) {
    emit_ = makeComputeProgram(setup.device, setup.compiler.compile("passes/trace_gather_rays/emit.comp"));
    sampler_ = texelSampler(setup.device);
}

void TraceGatherRays::record(PassContext& context) {
    const GBuffer& gbuffer = context.get(gbuffer_);
    GatherHits& hits = context.get(hits_);
    hits.layout.seed = randomSeed(context.frame, context.frameIndex);
    for (uint32_t b = 0; b < hits.batches.size(); ++b) {
        const uint32_t blocks = hits.batchBlocks(b), rays = blocks * params_.raysPerBlock;
        context.stream.dispatch(
            emit_,
            context.scene.bindings({{"position", gbuffer.position, sampler_},
                                    {"normal", gbuffer.normal, sampler_},
                                    {"geometricNormal", gbuffer.geometricNormal, sampler_},
                                    {"rays", rays_}}),
            GatherEmitPush{hits.layout, b * hits.blocksPerBatch, blocks}, linearGroups(rays));
        context.tracer.closestHit(context.stream, rays_, hits.batches[b], rays);
    }
}

}  // namespace voxray
