#include "passes/direct_shadow_maps/direct_shadow_maps.h"

#include "passes/common/compute/dispatch.h"
#include "passes/common/lights/pane_tint.h"

namespace voxray {
namespace {

struct ShadePush {
    uint32_t samples;
    uint32_t resolution, views;
    glm::vec3 camera;
};

}  // namespace

void DirectShadowMaps::declare(PassBuilder& builder) {
    gbuffer_ = builder.read<GBuffer>("gbuffer", "what the camera sees");
    rsm_ = builder.read<Rsm>("rsm", "what lights see");
    direct_ = builder.write<FrameImage>("direct", "radiance reflected of direct light");
}

void DirectShadowMaps::plan(PassPlan& plan) {
    requireClearPanes(*plan.frame.scene, kName);
    plan.image(plan.get(direct_).image, "direct", frameImageDesc(plan.frame));
}

void DirectShadowMaps::prepare(PassSetup& setup) {
    shade_ = makeComputeProgram(setup.device, setup.compiler.compile("passes/direct_shadow_maps/shade.comp"));
    sampler_ = texelSampler(setup.device);
}

void DirectShadowMaps::record(PassContext& context) {
    const GBuffer& gbuffer = context.get(gbuffer_);
    const Rsm& rsm = context.get(rsm_);
    std::vector<Binding> bindings =
        context.scene.bindings({{"position", gbuffer.position, sampler_},
                                {"normal", gbuffer.normal, sampler_},
                                {"geometricNormal", gbuffer.geometricNormal, sampler_},
                                {"albedo", gbuffer.albedo, sampler_},
                                {"specular", gbuffer.specular, sampler_},
                                {"fresnel", gbuffer.fresnel, sampler_},
                                {"direct", context.get(direct_).image}});
    for (const Binding& binding : rsm.bindings()) bindings.push_back(binding);
    context.stream.dispatch(
        shade_, bindings,
        ShadePush{gbuffer.samples, rsm.resolution, rsm.firstView.back(), context.frame.camera.position},
        pixelGroups(context.frame.width, context.frame.height));
}

}  // namespace voxray
