#include "passes/vpls/sample_vpls/rsm_sampling.h"

#include <algorithm>

namespace voxray {
namespace {

// Sum of a source's weights. The texels' sum differs from the source's power by less than a factor of 2 at
// the smallest resolution, so it stays below 2^32.
constexpr float kUnits = 1u << 30;

}  // namespace

RsmSampling::RsmSampling(ProgramOwner& owner)
    : computeWeights_(owner, "rsm_texel_weights.comp"),
      sampleTexels_(owner, "rsm_sample_texels.comp"),
      prefixSum_(owner, PrefixSum::Input::Uints) {}

void RsmSampling::plan(PassPlan& plan, const Rsm& rsm) {
    uint32_t views = 0;
    for (size_t s = 0; s < rsm.sources.size(); ++s) views = std::max(views, rsm.firstView[s + 1] - rsm.firstView[s]);
    const uint64_t texels = uint64_t(views) * rsm.texelsPerView();
    plan.scratchBuffer(weights_, "weights of shadow maps' texels", texels * sizeof(uint32_t));
}

void RsmSampling::emit(PassContext& context, const Rsm& rsm, size_t source, const Target& target) const {
    const uint32_t firstView = rsm.firstView[source], views = rsm.firstView[source + 1] - firstView;
    const uint32_t texels = views * rsm.texelsPerView();
    context.dispatch(computeWeights_, texels,
                     {context.scene,
                      rsm,
                      {"weights", weights_},
                      {"resolution", rsm.resolution},
                      {"firstView", firstView},
                      {"texels", texels},
                      {"unitsPerWatt", kUnits / rsm.sources[source].power}});
    const uint32_t weightSum = prefixSum_.run(context.stream, weights_, weights_, texels);
    context.dispatch(sampleTexels_, target.batch.count,
                     {context.scene,
                      rsm,
                      {"prefixSums", weights_},
                      {"rays", target.rays},
                      {"hits", target.hits},
                      {"paths", target.paths},
                      {"resolution", rsm.resolution},
                      {"firstView", firstView},
                      {"rows", views * rsm.resolution},
                      {"weightSum", weightSum},
                      {"firstPath", target.batch.first},
                      {"count", target.batch.count},
                      {"lightPaths", target.batch.rays},
                      {"seed", target.batch.seed}});
}

}  // namespace voxray
