#include "passes/vpls/gather_vpls/traced_shadow_maps.h"

namespace voxray {

TracedShadowMaps::TracedShadowMaps(ProgramOwner& owner, uint32_t resolution)
    : VplShadowMaps(resolution, kTexels / (resolution * resolution)), generateRays_(owner, "generate_map_rays.comp") {}

void TracedShadowMaps::plan(PassPlan& plan) {
    plan.buffer(rays_, "rays of shadow maps", kTexels * sizeof(Ray));
    plan.buffer(hits_, "shadow maps", kTexels * sizeof(Hit));
}

void TracedShadowMaps::render(PassContext& context, const Vpls& vpls, uint32_t first, uint32_t count) const {
    const uint32_t rays = count * resolution() * resolution();
    context.dispatch(generateRays_, rays,
                     {context.scene,
                      {"VplsRef", vpls.points.ref()},
                      {"activeVpls", vpls.activeIndices},
                      {"rays", rays_},
                      {"firstVpl", first},
                      {"vplCount", count},
                      {"resolution", resolution()}});
    context.tracer.closestHit(context.stream, rays_, hits_, rays);
}

}  // namespace voxray
