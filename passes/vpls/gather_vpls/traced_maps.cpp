#include "passes/vpls/gather_vpls/traced_maps.h"

namespace voxray {

TracedMaps::TracedMaps(ProgramOwner& owner, uint32_t resolution)
    : VplMaps(resolution), aim_(owner, "map_rays.comp") {}

void TracedMaps::plan(PassPlan& plan) {
    plan.buffer(rays_, "rays of shadow maps", kTexels * sizeof(Ray));
    plan.buffer(hits_, "shadow maps", kTexels * sizeof(Hit));
}

void TracedMaps::draw(PassContext& context, const Vpls& vpls, uint32_t first, uint32_t count) const {
    const uint32_t rays = count * resolution() * resolution();
    context.dispatch(aim_, rays,
                     {context.scene,
                      {"VplsAt", vpls.points.at()},
                      {"list", vpls.list},
                      {"rays", rays_},
                      {"firstVpl", first},
                      {"vplCount", count},
                      {"resolution", resolution()}});
    context.tracer.closestHit(context.stream, rays_, hits_, rays);
}

}  // namespace voxray
