#include "passes/gather_stepped_cones/gather_stepped_cones.h"

#include "passes/common/compute/dispatch.h"

namespace voxray {
namespace {

struct StepPush {
    uint32_t samples;
    float step;
    float start;
};

}  // namespace

void GatherSteppedCones::declare(PassBuilder& builder) {
    gbuffer_ = builder.read<GBuffer>("gbuffer", "what the camera sees");
    radiance_ = builder.read<RadianceVoxels>("radiance", "light that leaves surfaces, at all scales");
    indirect_ = builder.write<FrameImage>("indirect", "radiance reflected of indirect light");
}

void GatherSteppedCones::plan(PassPlan& plan) {
    plan.get(indirect_).lightBounces = plan.get(radiance_).lightBounces;
    plan.image(plan.get(indirect_).image, "indirect", frameImageDesc(plan.frame));
}

void GatherSteppedCones::prepare(PassSetup& setup) {
    trace_ = makeComputeProgram(setup.device, setup.compiler.compile("passes/gather_stepped_cones/trace.comp",
                                                                     setup.get(radiance_).defines()));
    sampler_ = texelSampler(setup.device);
}

void GatherSteppedCones::record(PassContext& context) {
    const GBuffer& gbuffer = context.get(gbuffer_);
    std::vector<Binding> bindings = context.get(radiance_).bindings();
    bindings.insert(bindings.end(), {{"position", gbuffer.position, sampler_},
                                     {"normal", gbuffer.normal, sampler_},
                                     {"albedo", gbuffer.albedo, sampler_},
                                     {"result", context.get(indirect_).image}});
    context.stream.dispatch(trace_, bindings, StepPush{gbuffer.samples, params_.step, params_.start},
                            pixelGroups(context.frame.width, context.frame.height));
}

}  // namespace voxray
