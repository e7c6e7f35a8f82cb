#include "passes/smooth_surfels/smooth_surfels.h"

#include <algorithm>
#include <utility>

#include "passes/common/compute/dispatch.h"

namespace voxray {
namespace {

constexpr uint64_t kSurroundingsBytes = 4 * sizeof(float), kLitBytes = 3 * sizeof(uint32_t);

struct SmoothPush {
    uint32_t count;
    float noise;
};

}  // namespace

void SmoothSurfels::declare(PassBuilder& builder) {
    surfels_ = builder.read<SurfelsByVoxel>("surfels_by_voxel", "surfels, in the slots of their light");
    neighbours_ = builder.read<SurfelNeighbours>("neighbours", "the surfels around each surfel");
    light_ = builder.read<SurfelIrradiance>("surfel_irradiance", "light that arrives at surfels");
    smooth_ = builder.write<SurfelIrradiance>("surfel_irradiance", "the same with less noise");
}

void SmoothSurfels::plan(PassPlan& plan) {
    const uint64_t slots = plan.get(surfels_).maxCount;
    plan.get(smooth_).relativeVariance = plan.get(light_).relativeVariance;
    plan.reserve("smooth irradiance of surfels (estimated)", slots * kLitBytes);
    plan.reserveScratch("surroundings of surfels (estimated)", slots * (kSurroundingsBytes + kLitBytes));
}

void SmoothSurfels::prepare(PassSetup& setup) {
    const auto program = [&](const char* file) {
        return makeComputeProgram(setup.device, setup.compiler.compile(file));
    };
    surroundings_ = program("passes/smooth_surfels/surroundings.comp");
    mean_ = program("passes/smooth_surfels/mean.comp");
}

void SmoothSurfels::record(PassContext& context) {
    const SurfelsByVoxel& surfels = context.get(surfels_);
    const uint32_t count = surfels.slotCount;
    const uint64_t slots = std::max(count, 1u);
    LargeBuffer& result = context.get(smooth_).lit;
    result = {};
    result = LargeBuffer(context.device, "smooth irradiance of surfels", slots * kLitBytes);
    LargeBuffer other(context.device, "irradiance one step before", slots * kLitBytes);
    const LargeBuffer surroundings(context.device, "surroundings of surfels", slots * kSurroundingsBytes);

    const SurfelNeighbours& neighbours = context.get(neighbours_);
    const SmoothPush push{count, context.get(light_).relativeVariance};
    const LargeBuffer* from = &context.get(light_).lit;
    for (uint32_t i = 0; i < params_.iterations; ++i) {
        // The last iteration writes the result.
        LargeBuffer& to = (params_.iterations - i) % 2 == 1 ? result : other;
        std::vector<Binding> bindings{{"begins", neighbours.begins},
                                      {"PairsAt", neighbours.pairs.at()},
                                      {"LitAt", from->at()},
                                      {"SurroundingsAt", surroundings.at()}};
        context.stream.dispatch(surroundings_, bindings, push, linearGroups(count));
        bindings.push_back({"ResultAt", to.at()});
        context.stream.dispatch(mean_, bindings, push, linearGroups(count));
        from = &to;
    }
    context.stream.finish();
}

}  // namespace voxray
