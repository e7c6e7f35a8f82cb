#include "passes/render_rsm/render_rsm.h"

#include "base/error.h"

namespace voxray {
namespace {

constexpr uint32_t kCubeSides = 6;

}  // namespace

void RenderRsm::declare(PassBuilder& builder) {
    rsm_ = builder.write<Rsm>("rsm", "what each light sees");
}

void RenderRsm::plan(PassPlan& plan) {
    const SceneState& state = *plan.frame.scene;
    Rsm& rsm = plan.get(rsm_);
    rsm.resolution = params_.rsmResolution;
    rsm.sources =
        requireViewpoints(state, kName, "direct_shadow_rays, and 'first: light_rays' of sample_vpls");
    rsm.firstView = {0};
    for (const LightSource& source : rsm.sources)
        rsm.firstView.push_back(rsm.firstView.back() +
                                uint32_t(lightViews(state.lights[source.light], state.geometry).size()));
    const uint64_t bytes = uint64_t(rsm.texelsPerView()) * sizeof(gpu::RsmTexel);
    image_.plan(plan, rsm.resolution);
    plan.scratchBuffer(texels_, "a reflective shadow map's texels", bytes);
    plan.buffer(rsm.views, "lights' views", rsm.firstView.back() * sizeof(gpu::RsmView));
    plan.buffer(rsm.texels, "reflective shadow maps", rsm.firstView.back() * bytes);
}

void RenderRsm::prepare(PassSetup& setup) {
    image_.prepare(setup);
}

void RenderRsm::record(PassContext& context) {
    const SceneState& state = *context.frame.scene;
    const Rsm& rsm = context.get(rsm_);
    CommandStream& stream = context.stream;
    std::vector<gpu::RsmView> views;
    for (const LightSource& source : rsm.sources) {
        const auto own = lightViews(state.lights[source.light], state.geometry);
        for (uint32_t v = 0; v < own.size(); ++v)
            views.push_back({own[v], source.light, own.size() == kCubeSides ? v : kCubeSides});
    }
    stream.upload(rsm.views, views);
    for (size_t v = 0; v < views.size(); ++v) {
        image_.draw(context, views[v].view);
        stream.copy(image_.image(), texels_);
        stream.copy(texels_, rsm.texels, texels_.bytes(), 0, v * texels_.bytes());
    }
}

}  // namespace voxray
