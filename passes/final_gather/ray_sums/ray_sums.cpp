#include "passes/final_gather/ray_sums/ray_sums.h"

#include "base/error.h"

namespace voxray {
namespace {

uint32_t texelsPerBlock(const GatherHits& hits) {
    return hits.layout.blockSize * hits.layout.blockSize;
}

bool hasTexelsWithoutRays(const GatherHits& hits) {
    return hits.layout.raysPerBlock < texelsPerBlock(hits);
}

}  // namespace

void RaySums::requireRays(const GatherHits& hits, const char* pass) {
    const gpu::GatherLayout& layout = hits.layout;
    if (hasTexelsWithoutRays(hits))
        throw Error(
            "{3}: blocks of {0}x{0} texels have {1} rays, which leaves texels without any; "
            "let filter_irradiance follow, or raise 'rays_per_block' of trace_gather_rays to {2}",
            layout.blockSize, layout.raysPerBlock, texelsPerBlock(hits), pass);
}

void RaySums::plan(PassPlan& plan, const GatherHits& hits, uint32_t samples, NoisyIrradiance& noisy,
                   bool needsMoments) {
    noisy.spacing = hasTexelsWithoutRays(hits) ? hits.layout.blockSize : 1;
    averageTexels_.compileIf(!hasTexelsWithoutRays(hits));
    scatterRays_.compileIf(hasTexelsWithoutRays(hits));
    plan.image(noisy.irradiance, "noisy irradiance", NoisyIrradiance::desc(plan.frame, samples));
    sumMoments_.compileIf(noisy.isRead || needsMoments);
    if (!noisy.isRead && !needsMoments) return;
    noisy.blockSize = hits.layout.blockSize;
    plan.buffer(noisy.moments, "moments of rays", noisy.momentsBytes(hits.layout.texels));
}

void RaySums::average(PassContext& context, const GatherHits& hits, uint32_t batch, const Buffer& light,
                      const Image& irradiance) const {
    const uint32_t blocks = hits.batchBlocks(batch);
    const Bindings bindings{{"light", light},
                            {"gathered", irradiance},
                            {"layout", hits.layout},
                            {"firstBlock", batch * hits.blocksPerBatch},
                            {"batchBlocks", blocks}};
    if (!hasTexelsWithoutRays(hits)) {
        context.dispatch(averageTexels_, uint64_t(blocks) * texelsPerBlock(hits), bindings);
        return;
    }
    if (batch == 0) context.stream.clear(irradiance, {});
    context.dispatch(scatterRays_, uint64_t(blocks) * hits.layout.raysPerBlock, bindings);
}

void RaySums::addMoments(PassContext& context, const GatherHits& hits, uint32_t batch, const Buffer& light,
                         const Buffer& moments) const {
    const uint32_t blocks = hits.batchBlocks(batch);
    context.dispatch(sumMoments_, blocks,
                     {{"light", light},
                      {"moments", moments},
                      {"firstBlock", batch * hits.blocksPerBatch},
                      {"batchBlocks", blocks},
                      {"raysPerBlock", hits.layout.raysPerBlock}});
}

void RaySums::add(PassContext& context, const GatherHits& hits, uint32_t batch, const Buffer& light,
                  const NoisyIrradiance& noisy) const {
    average(context, hits, batch, light, noisy.irradiance);
    if (noisy.isRead) addMoments(context, hits, batch, light, noisy.moments);
}

}  // namespace voxray
