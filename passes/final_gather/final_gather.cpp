#include "passes/final_gather/final_gather.h"

#include "base/error.h"
#include "passes/common/compute/random_seed.h"

namespace voxray {
namespace {

/// As in hit.glsl.
struct Counts {
    uint32_t surfels, unlit;
};

uint64_t batchRays(const GatherHits& hits) {
    return uint64_t(hits.blocksPerBatch) * hits.layout.raysPerBlock;
}

constexpr uint64_t kLightBytes = 4 * sizeof(float);  // Of a ray, or of a surfel.

}  // namespace

FinalGather::FinalGather(Pass& pass, const char* sourceFile)
    : owner_(pass),
      gbuffer_(pass, "gbuffer", "what the camera sees"),
      hits_(pass, "gather_hits", "where the gather rays hit"),
      noisy_(pass, "noisy_irradiance", "irradiance from few rays a texel"),
      indirect_(pass, "indirect", "radiance reflected of indirect light, unfiltered"),
      shade_(pass, "shade.comp", {}, sourceFile),
      reflect_(pass, "passes/surfels/reflect_at_hits.comp"),
      goOn_(pass, "go_on.comp", {}, sourceFile),
      collect_(pass, "collect.comp"),
      moments_(pass, "moments.comp") {}

void FinalGather::plan(PassPlan& plan, const Settings& settings) {
    settings_ = settings;
    const GatherHits& hits = plan[hits_];
    const uint32_t texelsPerBlock = hits.layout.blockSize * hits.layout.blockSize;
    NoisyIrradiance& noisy = plan[noisy_];
    noisy.lightBounces = plan[indirect_].lightBounces = oneMore(settings.storedBounces);
    noisy.spacing = hits.layout.raysPerBlock < texelsPerBlock ? hits.layout.blockSize : 1;
    if (plan[indirect_].isRead && noisy.spacing > 1)
        throw Error(
            "{3}: blocks of {0}x{0} texels have {1} rays, which leaves texels without any; let "
            "filter_irradiance follow, or raise 'rays_per_block' of trace_gather_rays to {2}",
            hits.layout.blockSize, hits.layout.raysPerBlock, texelsPerBlock, settings.pass);
    plan.image(noisy.irradiance, "noisy irradiance",
               NoisyIrradiance::desc(plan.frame, plan[gbuffer_].samples));
    if (noisy.isRead) {
        noisy.blockSize = hits.layout.blockSize;
        plan.buffer(noisy.moments, "moments of rays", noisy.momentsBytes(hits.layout.texels));
    }
    if (FrameImage& indirect = plan[indirect_]; indirect.isRead) {
        plan.frameImage(indirect_);
        resolve_.emplace(owner_);
    }
    plan.buffer(light_, "light of gather rays", batchRays(hits) * kLightBytes);
    plan.buffer(surfels_[0], "surfels at hits", batchRays(hits) * sizeof(gpu::Surfel));
    plan.buffer(goesOn_, "surfels whose rays go on", batchRays(hits) * 2 * sizeof(uint32_t));
    plan.buffer(counts_, "counts of hits", sizeof(Counts));
    if (measuresDirect()) {
        sources_ = lightSources(*plan.frame.scene);
        hitLight_.emplace(owner_).plan(plan, uint32_t(batchRays(hits)));
        plan.buffer(surfels_[1], "surfels one step before", batchRays(hits) * sizeof(gpu::Surfel));
        plan.buffer(direct_, "direct light at hits", batchRays(hits) * kLightBytes);
        plan.buffer(rays_, "next rays", batchRays(hits) * sizeof(Ray));
        plan.buffer(nextHits_, "next hits", batchRays(hits) * sizeof(Hit));
    }
    for (Kernel* reader : {&shade_, &goOn_}) {
        reader->define(settings.shadowRays ? Defines{{"SHADOW_RAYS", "1"}} : Defines{});
        reader->specialize(settings.constants);
    }
    moments_.compileIf(noisy.isRead);
    reflect_.compileIf(measuresDirect());
    goOn_.compileIf(measuresDirect());
}

void FinalGather::record(PassContext& context, const std::vector<Binding>& stored) {
    traced_ = unlit_ = 0;
    for (uint32_t b = 0; b < context[hits_].batches.size(); ++b) gather(context, stored, b);
    context.report(settings_.unlit, traced_ > 0 ? 100 * unlit_ / traced_ : 0);
    if (resolve_)
        resolve_->record(context, context[gbuffer_], context[noisy_].irradiance, context[indirect_].image);
}

void FinalGather::gather(PassContext& context, const std::vector<Binding>& stored, uint32_t batch) {
    const GatherHits& hits = context[hits_];
    const uint32_t firstBlock = batch * hits.blocksPerBatch, blocks = hits.batchBlocks(batch);
    const uint32_t rays = blocks * hits.layout.raysPerBlock;
    const uint32_t texelsPerBlock = hits.layout.blockSize * hits.layout.blockSize;

    // Shade the hits with the irradiance that is stored there, and measure light where none is to be had.
    traced_ += rays;
    context.stream.fill(counts_, 0);
    context.dispatch(shade_, rays,
                     {endBindings(context, stored, hits.batches[batch], surfels_[0]),
                      context[gbuffer_],
                      {"layout", hits.layout},
                      {"firstBlock", firstBlock},
                      {"rays", rays},
                      {"nearField", settings_.nearFieldCells}});
    follow(context, stored);

    // Add up what the rays of each texel and of each block bring.
    const NoisyIrradiance& noisy = context[noisy_];
    context.dispatch(collect_, uint64_t(blocks) * texelsPerBlock,
                     {{"light", light_},
                      {"gathered", noisy.irradiance},
                      {"layout", hits.layout},
                      {"firstBlock", firstBlock},
                      {"batchBlocks", blocks}});
    if (noisy.isRead)
        context.dispatch(moments_, blocks,
                         {{"light", light_},
                          {"moments", noisy.moments},
                          {"firstBlock", firstBlock},
                          {"batchBlocks", blocks},
                          {"raysPerBlock", hits.layout.raysPerBlock}});
}

std::vector<Binding> FinalGather::endBindings(PassContext& context, const std::vector<Binding>& stored,
                                              const Buffer& hits, const Buffer& surfels) const {
    std::vector<Binding> all = context.scene.bindings(
        {{"hits", hits}, {"light", light_}, {"surfels", surfels}, {"goesOn", goesOn_}, {"counts", counts_}});
    all.insert(all.end(), stored.begin(), stored.end());
    return all;
}

uint32_t FinalGather::takeCounts(CommandStream& stream) {
    const Counts counts = stream.readAs<Counts>(counts_, 1)[0];
    unlit_ += counts.unlit;
    return counts.surfels;
}

void FinalGather::follow(PassContext& context, const std::vector<Binding>& stored) {
    CommandStream& stream = context.stream;
    for (uint32_t step = 0; step <= settings_.maxSteps; ++step) {
        const uint32_t surfels = takeCounts(stream);
        if (surfels == 0) return;

        // Direct light at the surfels, and rays on.
        const Buffer &from = surfels_[step % 2], &to = surfels_[(step + 1) % 2];
        const uint32_t seed = randomSeed(context.frame, context.frameIndex) + 0x51u + step * 0x9e3779b9u;
        hitLight_->measure(context, sources_, from, surfels, settings_.lightSamples, seed, direct_);
        context.dispatch(reflect_, surfels,
                         {context.scene,
                          {"surfels", from},
                          {"direct", direct_},
                          {"light", light_},
                          {"goesOn", goesOn_},
                          {"rays", rays_},
                          {"count", surfels},
                          {"seed", seed + 0xa3u}});
        if (settings_.nearFieldCells == 0 || step == settings_.maxSteps) return;

        // Where those end.
        context.tracer.closestHit(stream, rays_, nextHits_, surfels);
        traced_ += surfels;
        stream.fill(counts_, 0);
        const bool isLast = step + 1 == settings_.maxSteps;
        context.dispatch(goOn_, surfels,
                         {endBindings(context, stored, nextHits_, to),
                          {"from", from},
                          {"rays", rays_},
                          {"rays", surfels},
                          {"nearField", isLast ? 0.0f : settings_.nearFieldCells}});
    }
}

}  // namespace voxray
