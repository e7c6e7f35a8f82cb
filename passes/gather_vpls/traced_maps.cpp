#include "passes/gather_vpls/traced_maps.h"

#include "passes/common/compute/dispatch.h"

namespace voxray {
namespace {

struct MapAimPush {
    uint32_t firstVpl, vplCount;
    uint32_t resolution;
};

}  // namespace

void TracedMaps::plan(PassPlan& plan) {
    plan.buffer(rays_, "rays of shadow maps", kTexels * sizeof(Ray));
    plan.buffer(hits_, "shadow maps", kTexels * sizeof(Hit));
}

void TracedMaps::prepare(PassSetup& setup) {
    aim_ = makeComputeProgram(setup.device, setup.compiler.compile("passes/gather_vpls/map_rays.comp"));
}

void TracedMaps::draw(PassContext& context, const Vpls& vpls, uint32_t first, uint32_t count) const {
    const uint32_t rays = count * resolution() * resolution();
    context.stream.dispatch(
        aim_, context.scene.bindings({{"VplsAt", vpls.points.at()}, {"list", vpls.list}, {"rays", rays_}}),
        MapAimPush{first, count, resolution()}, linearGroups(rays));
    context.tracer.closestHit(context.stream, rays_, hits_, rays);
}

}  // namespace voxray
