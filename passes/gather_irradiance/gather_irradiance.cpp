#include "passes/gather_irradiance/gather_irradiance.h"

#include "passes/common/frame_image.h"

namespace voxray {

void GatherIrradiance::declare(PassBuilder& builder) {
    gbuffer_ = builder.read<GBuffer>("gbuffer", "what the camera sees");
    voxels_ = builder.read<SurfaceVoxels>("voxels", "surface voxels");
    irradiance_ = builder.read<VoxelIrradiance>("irradiance", "light that arrives at the voxels' surfaces");
    indirect_ = builder.write<FrameImage>("indirect", "radiance reflected of indirect light");
}

void GatherIrradiance::plan(PassPlan& plan) {
    plan.reserve("indirect image", imageBytes(frameImageDesc(plan.frame)));
}

void GatherIrradiance::prepare(PassSetup& setup) {
    setup.get(indirect_).image = Image(setup.device, "indirect", frameImageDesc(setup.frame));
    lookup_ = VoxelLookup(setup.device, setup.compiler);
}

void GatherIrradiance::record(PassContext& context) {
    const VoxelIrradiance& irradiance = context.get(irradiance_);
    lookup_.run(context.stream, context.get(gbuffer_), context.get(voxels_), irradiance.indirect,
                irradiance.area, context.get(indirect_).image, params_.radius);
}

}  // namespace voxray
