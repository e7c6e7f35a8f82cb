#include "passes/gather_vpls/vpl_shadow_maps.h"

#include "passes/common/compute/dispatch.h"

namespace voxray {
namespace {

constexpr uint32_t kTexels = 1u << 20;  // Of all maps at a time: bounds the memory to 48 MiB.

struct AimPush {
    uint32_t firstVpl, vplCount;
    uint32_t resolution;
};

}  // namespace

void VplShadowMaps::plan(PassPlan& plan, uint32_t resolution) {
    resolution_ = resolution;
    plan.buffer(rays_, "rays of shadow maps", kTexels * sizeof(Ray));
    plan.buffer(hits_, "shadow maps", kTexels * sizeof(Hit));
}

void VplShadowMaps::prepare(PassSetup& setup) {
    aim_ = makeComputeProgram(setup.device, setup.compiler.compile("passes/gather_vpls/map_rays.comp"));
}

uint32_t VplShadowMaps::capacity() const {
    return kTexels / (resolution_ * resolution_);
}

void VplShadowMaps::draw(PassContext& context, const Vpls& vpls, uint32_t first, uint32_t count) const {
    const uint32_t rays = count * resolution_ * resolution_;
    context.stream.dispatch(aim_, {{"vpls", vpls.points}, {"list", vpls.list}, {"rays", rays_}},
                            AimPush{first, count, resolution_}, linearGroups(rays));
    context.tracer.closestHit(context.stream, rays_, hits_, rays);
}

}  // namespace voxray
