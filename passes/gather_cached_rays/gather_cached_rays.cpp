#include "passes/gather_cached_rays/gather_cached_rays.h"

namespace voxray {
namespace {

constexpr uint32_t kMaxSegments = 7;  // In a cache without a cell rays become paths of eight bounces.

}  // namespace

void GatherCachedRays::declare(PassBuilder& builder) {
    cache_ = builder.read<RadianceCache>("radiance_cache", "light that arrives at surfaces, by hashed cells");
    gather_.declare(builder);
}

void GatherCachedRays::plan(PassPlan& plan) {
    FinalGather::Settings settings{kName, {{"minSamples", params_.minSamples}}};
    settings.lightSamples = params_.lightSamples;
    settings.nearFieldCells = params_.nearFieldCells;
    settings.maxSteps = kMaxSegments;
    settings.unlit = "hits without a cell, % of rays";
    settings.storedBounces = plan.get(cache_).lightBounces;
    gather_.plan(plan, settings);
}

void GatherCachedRays::prepare(PassSetup& setup) {
    gather_.prepare(setup);
}

void GatherCachedRays::record(PassContext& context) {
    gather_.record(context, context.get(cache_).bindings());
}

}  // namespace voxray
