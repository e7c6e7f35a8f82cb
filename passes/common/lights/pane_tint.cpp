#include "passes/common/lights/pane_tint.h"

#include "base/error.h"
#include "passes/common/compute/dispatch.h"
#include "scene/panes.h"

namespace voxray {
namespace {

/// Panes that one ray crosses, at most: a bound on what a scene of glass may cost.
constexpr uint32_t kMaxPanes = 64;

struct CrossPush {
    uint32_t count;
    uint32_t stride;
};

}  // namespace

void requireClearPanes(const SceneState& state, const std::string& pass) {
    if (!dimsLight(state)) return;
    const Scene& panes = *state.panes->scene;
    const Mesh& mesh = panes.meshes[panes.instances.front().mesh];
    throw Error(
        "{}: its light takes on no colour of the scene's panes, such as '{}'; take them out with "
        "'scene.hide', make "
        "them opaque with 'materials: lambert', or light by shadow rays or light rays",
        pass, panes.materials[mesh.material].name);
}

void PaneTint::plan(PassPlan& plan, uint64_t rays) {
    if (!dimsLight(*plan.frame.scene)) return;
    plan.scratchBuffer(rays_, "rays on to the next pane", rays * sizeof(Ray));
    plan.scratchBuffer(hits_, "panes that rays cross", rays * sizeof(Hit));
    plan.scratchBuffer(active_, "rays that go on to panes", sizeof(uint32_t));
}

void PaneTint::prepare(PassSetup& setup) {
    const auto program = [&](const char* file, const Defines& defines = {}) {
        return makeComputeProgram(setup.device, setup.compiler.compile(file, defines));
    };
    begin_ = program("passes/common/lights/pane_begin.comp");
    beginAtHits_ = program("passes/common/lights/pane_begin.comp", {{"AT_HITS", "1"}});
    cross_ = program("passes/common/lights/pane_cross.comp");
}

void PaneTint::apply(PassContext& context, const Buffer& rays, const Buffer& carried, uint32_t stride,
                     uint32_t count, const Buffer* hits) const {
    RayTracer* panes = context.tracer.panes();
    if (!panes) return;
    CommandStream& stream = context.stream;
    std::vector<Binding> beginning{{"rays", rays}, {"paneRays", rays_}};
    if (hits) beginning.emplace_back("hits", *hits);
    stream.dispatch(hits ? beginAtHits_ : begin_, beginning, count, linearGroups(count));

    // One pane after the other.
    for (uint32_t pane = 0; pane < kMaxPanes; ++pane) {
        panes->closestHit(stream, rays_, hits_, count);
        stream.fill(active_, 0);
        stream.dispatch(
            cross_,
            context.scene.panes->bindings(
                {{"paneRays", rays_}, {"paneHits", hits_}, {"carried", carried}, {"active_", active_}}),
            CrossPush{count, stride}, linearGroups(count));
        if (stream.readAs<uint32_t>(active_, 1)[0] == 0) return;
    }
}

}  // namespace voxray
