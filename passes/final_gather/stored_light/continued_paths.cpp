#include "passes/final_gather/stored_light/continued_paths.h"

#include "passes/common/compute/random_seed.h"

namespace voxray {
namespace {

/// As in shade_hit.glsl.
struct HitCounts {
    uint32_t surfels, continued, unlit, traced;
};

}  // namespace

ContinuedPaths::ContinuedPaths(ProgramOwner& owner, const Defines& stored)
    : owner_(owner),
      reflect_(owner, "passes/surfels/reflect_at_hits.comp", {{"ROULETTE", "1"}}),
      continue_(owner, "continue_paths.comp", stored) {}

void ContinuedPaths::plan(PassPlan& plan, const StoredLightParams& params, bool measureDirect, uint32_t rays) {
    params_ = params;
    measureDirect_ = measureDirect;
    continue_.define(defines());
    reflect_.compileIf(isUsed());
    continue_.compileIf(isUsed());
    plan.buffer(surfels_[0], "surfels at hits", rays * sizeof(gpu::Surfel));
    plan.buffer(continuations_, "surfels whose paths continue", rays * 2 * sizeof(uint32_t));
    plan.buffer(counts_, "counts of hits", sizeof(HitCounts));
    if (!isUsed()) return;
    sources_ = lightSources(*plan.frame.scene);
    hitLight_.emplace(owner_).plan(plan, rays);
    plan.buffer(surfels_[1], "surfels at next hits", rays * sizeof(gpu::Surfel));
    plan.buffer(direct_, "direct light at hits", rays * 4 * sizeof(float));
    plan.buffer(rays_, "next rays", rays * sizeof(Ray));
    plan.buffer(hits_, "next hits", rays * sizeof(Hit));
}

Defines ContinuedPaths::defines() const {
    return measureDirect_ ? Defines{{"SHADOW_RAYS", "1"}} : Defines{};
}

std::vector<Binding> ContinuedPaths::clearHits(CommandStream& stream) const {
    stream.fill(counts_, 0);
    return {{"surfels", surfels_[0]}, {"continuations", continuations_}, {"counts", counts_}};
}

ContinuedPaths::Counts ContinuedPaths::trace(PassContext& context, const std::vector<Binding>& stored,
                                             const Buffer& light) const {
    CommandStream& stream = context.stream;
    Counts total;
    for (uint32_t step = 0; step <= maxSteps(); ++step) {
        const HitCounts hits = stream.readAs<HitCounts>(counts_, 1)[0];
        total.unlit += hits.unlit;
        total.rays += hits.traced;
        if (hits.surfels == 0) break;

        // Measure direct light at the surfels, and generate continuation rays
        const Buffer &from = surfels_[step % 2], &to = surfels_[(step + 1) % 2];
        const uint32_t seed = randomSeed(context.frame, context.frameIndex) + 0x51u + step * 0x9e3779b9u;
        hitLight_->measure(context, sources_, from, hits.surfels, params_.lightSamples, seed, direct_);
        context.dispatch(reflect_, hits.surfels,
                         {context.scene,
                          {"surfels", from},
                          {"direct", direct_},
                          {"light", light},
                          {"continuations", continuations_},
                          {"rays", rays_},
                          {"count", hits.surfels},
                          {"seed", seed + 0xa3u}});
        if (hits.continued == 0) break;

        // Trace these rays and shade their hits
        context.tracer.closestHit(stream, rays_, hits_, hits.surfels);
        stream.fill(counts_, 0);
        const bool isLast = step + 1 == maxSteps();
        context.dispatch(continue_, hits.surfels,
                         {context.scene,
                          stored,
                          {"origins", from},
                          {"rays", rays_},
                          {"hits", hits_},
                          {"light", light},
                          {"surfels", to},
                          {"continuations", continuations_},
                          {"counts", counts_},
                          {"rays", hits.surfels},
                          {"nearField", isLast ? 0.0f : params_.nearFieldCells}});
    }
    return total;
}

}  // namespace voxray
