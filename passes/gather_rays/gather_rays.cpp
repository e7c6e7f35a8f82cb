#include "passes/gather_rays/gather_rays.h"

namespace voxray {

void GatherRays::declare(PassBuilder& builder) {
    voxels_ = builder.read<SurfaceVoxels>("voxels", "surface voxels");
    irradiance_ = builder.read<VoxelIrradiance>("irradiance", "light that arrives at the voxels' surfaces");
    gather_.declare(builder);
}

void GatherRays::plan(PassPlan& plan) {
    FinalGather::Settings settings{kName};
    settings.shadowRays = shadowRays();
    settings.lightSamples = params_.lightSamples;
    settings.nearFieldCells = params_.nearFieldVoxels;
    settings.storedBounces = plan.get(irradiance_).lightBounces;
    gather_.plan(plan, settings);
    plan.buffer(grid_, "grid of voxels", sizeof(gpu::VoxelGrid));
    plan.reserve("face irradiance (estimated)", FaceIrradiance::bytes(plan.get(voxels_).voxelCount));
}

void GatherRays::prepare(PassSetup& setup) {
    gather_.prepare(setup);
    faces_ = FaceIrradiance(setup.device, setup.compiler);
    facesVersion_.reset();
}

void GatherRays::record(PassContext& context) {
    const SurfaceVoxels& voxels = context.get(voxels_);
    const VoxelIrradiance& light = context.get(irradiance_);
    if (const std::pair version{voxels.version, light.version}; facesVersion_ != version) {
        faces_.update(context.stream, voxels, light.area, light.indirect,
                      shadowRays() ? nullptr : &light.direct);
        context.stream.upload(grid_, std::vector{voxels.grid});
        facesVersion_ = version;
    }
    gather_.record(context, voxels.bindings({faces_.binding(), {"grid", grid_}}));
}

}  // namespace voxray
