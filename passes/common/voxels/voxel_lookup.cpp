#include "passes/common/voxels/voxel_lookup.h"

#include <cmath>

#include "base/error.h"

namespace voxray {

VoxelLookupPass::VoxelLookupPass(const Params& params, std::string port, std::string help,
                                 LargeBuffer VoxelIrradiance::*flux)
    : params_(params),
      portName_(std::move(port)),
      flux_(flux),
      reflected_(*this, portName_, std::move(help)) {}

uint32_t VoxelLookupPass::reach() const {
    const float radius = params_.lookup == VoxelLookup::BilinearFace ? 1.0f : params_.radius;
    const uint32_t tap = params_.lookup == VoxelLookup::SevenTap ? 1 : 0;
    // Of voxels whose centers are nearer than the radius, which voxel_irradiance.glsl doubles twice, to a
    // point anywhere in its own
    return uint32_t(std::ceil(4 * radius + 0.5f)) - 1 + tap;
}

void VoxelLookupPass::plan(PassPlan& plan) {
    const std::optional<uint32_t> known = plan[irradiance_].reach;
    if (known && *known < reach())
        throw Error(
            "the lookup reads voxels up to {} from what the camera sees, and light is gathered for those up "
            "to {}; set the 'reach' of gather_clusters to {}",
            reach(), *known, reach());
    if (flux_ == &VoxelIrradiance::indirect) plan[reflected_].lightBounces = plan[irradiance_].lightBounces;
    plan.frameImage(reflected_);
}

void VoxelLookupPass::record(PassContext& context) {
    const VoxelIrradiance& irradiance = context[irradiance_];
    context.dispatch(program_, context.frame.pixels(),
                     {context[gbuffer_],
                      context[voxels_],
                      {"VoxelFluxAt", (irradiance.*flux_).at()},
                      {"voxelArea", irradiance.area},
                      {"result", context[reflected_].image},
                      {"radius", params_.radius},
                      {"lookup", params_.lookup}});
}

}  // namespace voxray
