#include "passes/cones/gather_cones/specular_cones.h"

#include "passes/cones/gather_cones/lobe_types.h"

namespace voxray {
namespace {

constexpr uint32_t kPointsPerLobe = 1024;  // The error of the integrals is below 0.002.

ImageDesc reflectedImage(const Frame& frame, const GBuffer& gbuffer) {
    ImageDesc desc = frameImageDesc(frame);
    desc.extent = {gbufferExtent(frame, gbuffer.samples), 1};
    return desc;
}

}  // namespace

SpecularCones::SpecularCones(ProgramOwner& owner)
    : fillTable_(owner, "lobe_table.comp"), trace_(owner, "trace_specular_cones.comp") {}

void SpecularCones::plan(PassPlan& plan, const GBuffer& gbuffer, const RadianceVoxels& radiance, uint32_t strata,
                         Image& reflected) {
    strata_ = strata;
    plan.buffer(table_, "specular lobes", uint64_t(LOBES) * strata * sizeof(gpu::LobeStratum));
    plan.image(reflected, "specular reflection", reflectedImage(plan.frame, gbuffer));
    trace_.define(radiance.defines());
}

void SpecularCones::prepare(PassSetup& setup) const {
    setup.stream.dispatch(
        fillTable_, uint64_t(LOBES) * strata_,
        {{"strata", table_}, {"strataPerLobe", strata_}, {"pointsPerStratum", kPointsPerLobe / strata_}});
}

void SpecularCones::record(PassContext& context, const GBuffer& gbuffer, const RadianceVoxels& radiance,
                           const Image& reflected) const {
    context.dispatch(trace_, reflected.desc().extent,
                     {gbuffer,
                      radiance,
                      {"strata", table_},
                      {"reflected", reflected},
                      {"camera", context.frame.camera.position},
                      {"strataPerLobe", strata_}});
}

}  // namespace voxray
