#include "passes/sample_vpls/rsm_sampling.h"

#include <algorithm>

#include "passes/common/compute/dispatch.h"

namespace voxray {
namespace {

struct WeighPush {
    uint32_t resolution;
    uint32_t firstView;
    uint32_t texels;
    float unitsPerWatt;
};

struct PickPush {
    uint32_t resolution;
    uint32_t firstView;
    uint32_t rows;
    uint32_t sum;
    uint32_t firstPath, count;
    uint32_t paths;
    uint32_t seed;
};

// A source's weights in all. What texels add up to differs from the source's power by the size of texels, by
// less than a factor of 2 at the smallest resolution, so that the sum stays below 2^32.
constexpr float kUnits = 1u << 30;

}  // namespace

void RsmSampling::plan(PassPlan& plan, const Rsm& rsm) {
    uint32_t views = 0;
    for (size_t s = 0; s < rsm.sources.size(); ++s)
        views = std::max(views, rsm.firstView[s + 1] - rsm.firstView[s]);
    const uint32_t texels = views * rsm.texelsPerView();
    plan.scratchBuffer(weights_, "weights of shadow maps' texels", uint64_t(texels) * sizeof(uint32_t));
    plan.reserveScratch("prefix sums (estimated)", PrefixSum::scratchBytes(texels));
}

void RsmSampling::prepare(PassSetup& setup) {
    weigh_ = makeComputeProgram(setup.device, setup.compiler.compile("passes/sample_vpls/rsm_weigh.comp"));
    pick_ = makeComputeProgram(setup.device, setup.compiler.compile("passes/sample_vpls/rsm_pick.comp"));
    prefixSum_.emplace(setup.device, setup.compiler, PrefixSum::Of::Values);
}

void RsmSampling::emit(PassContext& context, const Rsm& rsm, size_t source, const Target& target) const {
    CommandStream& stream = context.stream;
    const auto bindings = [&](std::initializer_list<Binding> own) {
        std::vector<Binding> all = rsm.bindings();
        all.insert(all.end(), own);
        return context.scene.bindings(std::move(all));
    };
    const uint32_t firstView = rsm.firstView[source], views = rsm.firstView[source + 1] - firstView;
    const uint32_t texels = views * rsm.texelsPerView();
    const float unitsPerWatt = kUnits / rsm.sources[source].power;
    stream.dispatch(weigh_, bindings({{"weights", weights_}}),
                    WeighPush{rsm.resolution, firstView, texels, unitsPerWatt}, linearGroups(texels));
    const uint32_t sum = prefixSum_->run(stream, weights_, weights_, texels);
    stream.dispatch(
        pick_,
        bindings(
            {{"before", weights_}, {"rays", target.rays}, {"hits", target.hits}, {"paths", target.paths}}),
        PickPush{rsm.resolution, firstView, views * rsm.resolution, sum, target.batch.first,
                 target.batch.count, target.batch.rays, target.batch.seed},
        linearGroups(target.batch.count));
}

}  // namespace voxray
