#include "passes/direct_voxels/direct_voxels.h"

#include "passes/common/frame_image.h"

namespace voxray {

void DirectVoxels::declare(PassBuilder& builder) {
    gbuffer_ = builder.read<GBuffer>("gbuffer", "what the camera sees");
    voxels_ = builder.read<SurfaceVoxels>("voxels", "surface voxels");
    irradiance_ = builder.read<VoxelIrradiance>("irradiance", "light that arrives at the voxels' surfaces");
    direct_ = builder.write<FrameImage>("direct", "radiance reflected of direct light");
}

void DirectVoxels::plan(PassPlan& plan) {
    plan.reserve("direct image", imageBytes(frameImageDesc(plan.frame)));
}

void DirectVoxels::prepare(PassSetup& setup) {
    setup.get(direct_).image = Image(setup.device, "direct", frameImageDesc(setup.frame));
    lookup_ = VoxelLookup(setup.device, setup.compiler);
}

void DirectVoxels::record(PassContext& context) {
    const VoxelIrradiance& irradiance = context.get(irradiance_);
    lookup_.run(context.stream, context.get(gbuffer_), context.get(voxels_), irradiance.direct,
                irradiance.area, context.get(direct_).image, params_.radius);
}

}  // namespace voxray
