#include "passes/common/lights/pane_transmittance.h"

#include "base/error.h"
#include "scene/panes.h"

namespace voxray {
namespace {

constexpr uint32_t kMaxPanes = 64;  // Per ray: bounds the cost of scenes of glass.

}  // namespace

void requireClearPanes(const SceneState& state, const std::string& pass) {
    if (!dimsLight(state)) return;
    const Scene& panes = *state.panes->scene;
    const Mesh& mesh = panes.meshes[panes.instances.front().mesh];
    throw Error(
        "{}: its light takes on no colour of the scene's panes, such as '{}'; take them out with 'scene.hide', "
        "make them opaque with 'materials: lambert', or light by shadow rays or light rays",
        pass, panes.materials[mesh.material].name);
}

PaneTransmittance::PaneTransmittance(ProgramOwner& owner)
    : initRays_(owner, "init_pane_rays.comp"),
      initRaysAtHits_(owner, "init_pane_rays.comp", {{"AT_HITS", "1"}}),
      transmit_(owner, "pane_transmit.comp") {}

void PaneTransmittance::plan(PassPlan& plan, uint64_t rays) {
    const bool isUsed = dimsLight(*plan.frame.scene);
    for (Kernel* kernel : {&initRays_, &initRaysAtHits_, &transmit_}) kernel->compileIf(isUsed);
    if (!isUsed) return;
    plan.scratchBuffer(rays_, "rays on to the next pane", rays * sizeof(Ray));
    plan.scratchBuffer(hits_, "panes that rays cross", rays * sizeof(Hit));
    plan.scratchBuffer(active_, "rays that go on to panes", sizeof(uint32_t));
}

void PaneTransmittance::apply(PassContext& context, const Buffer& rays, const Buffer& throughput, uint32_t stride,
                              uint32_t count, const Buffer* hits) const {
    RayTracer* panes = context.tracer.panes();
    if (!panes) return;
    CommandStream& stream = context.stream;
    const Bindings bindings{{"rays", rays}, {"paneRays", rays_}, {"count", count}};
    if (hits)
        stream.dispatch(initRaysAtHits_, count, {bindings.all(), {"hits", *hits}});
    else
        stream.dispatch(initRays_, count, bindings);

    // One pane after the other.
    for (uint32_t pane = 0; pane < kMaxPanes; ++pane) {
        panes->closestHit(stream, rays_, hits_, count);
        stream.fill(active_, 0);
        stream.dispatch(transmit_, count,
                        {*context.scene.panes,
                         {"paneRays", rays_},
                         {"paneHits", hits_},
                         {"throughput", throughput},
                         {"active_", active_},
                         {"count", count},
                         {"stride", stride}});
        if (stream.readAs<uint32_t>(active_, 1)[0] == 0) return;
    }
}

}  // namespace voxray
