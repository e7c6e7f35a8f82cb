#include "passes/common/voxels/voxel_lookup.h"

#include <cmath>

#include "base/error.h"
#include "passes/common/compute/dispatch.h"
#include "passes/common/view/frame_image.h"

namespace voxray {
namespace {

struct LookupPush {
    gpu::VoxelGrid grid;
    float radius;
    uint32_t samples;
    uint32_t lookup;
};

}  // namespace

void VoxelLookupPass::declare(PassBuilder& builder) {
    gbuffer_ = builder.read<GBuffer>("gbuffer", "what the camera sees");
    voxels_ = builder.read<SurfaceVoxels>("voxels", "surface voxels");
    irradiance_ = builder.read<VoxelIrradiance>("irradiance", "light that arrives at the voxels' surfaces");
    reflected_ = builder.write<FrameImage>(portName_, portHelp_);
}

uint32_t VoxelLookupPass::reach() const {
    const float radius = params_.lookup == VoxelLookup::BilinearFace ? 1.0f : params_.radius;
    const uint32_t tap = params_.lookup == VoxelLookup::SevenTap ? 1 : 0;
    // Of voxels whose centers are nearer than the radius, which voxel_irradiance.glsl doubles twice, to a
    // point anywhere in its own
    return uint32_t(std::ceil(4 * radius + 0.5f)) - 1 + tap;
}

void VoxelLookupPass::plan(PassPlan& plan) {
    const std::optional<uint32_t> known = plan.get(irradiance_).reach;
    if (known && *known < reach())
        throw Error(
            "the lookup reads voxels up to {} from what the camera sees, and light is gathered for those up "
            "to "
            "{}; set the 'reach' of gather_clusters to {}",
            reach(), *known, reach());
    if (flux_ == &VoxelIrradiance::indirect)
        plan.get(reflected_).lightBounces = plan.get(irradiance_).lightBounces;
    plan.image(plan.get(reflected_).image, portName_, frameImageDesc(plan.frame));
}

void VoxelLookupPass::prepare(PassSetup& setup) {
    program_ =
        makeComputeProgram(setup.device, setup.compiler.compile("passes/common/voxels/voxel_lookup.comp"));
    sampler_ = texelSampler(setup.device);
}

void VoxelLookupPass::record(PassContext& context) {
    const GBuffer& gbuffer = context.get(gbuffer_);
    const SurfaceVoxels& voxels = context.get(voxels_);
    const VoxelIrradiance& irradiance = context.get(irradiance_);
    context.stream.dispatch(
        program_,
        voxels.bindings({{"position", gbuffer.position, sampler_},
                         {"normal", gbuffer.normal, sampler_},
                         {"albedo", gbuffer.albedo, sampler_},
                         {"VoxelFluxAt", (irradiance.*flux_).at()},
                         {"voxelArea", irradiance.area},
                         {"result", context.get(reflected_).image}}),
        LookupPush{voxels.grid, params_.radius, gbuffer.samples, uint32_t(params_.lookup)},
        pixelGroups(context.frame.width, context.frame.height));
}

}  // namespace voxray
