#include "passes/show_voxels/show_voxels.h"

#include "passes/common/compute/dispatch.h"
#include "scene/camera_rays.h"

namespace voxray {
namespace {

struct Push {
    gpu::VoxelGrid grid;
    glm::vec3 origin;
    glm::vec3 forward;
    glm::vec3 right;  ///< From the image's center to its edge, at a distance of 1.
    glm::vec3 up;
    uint32_t show;
};

}  // namespace

void ShowVoxels::declare(PassBuilder& builder) {
    voxels_ = builder.read<SurfaceVoxels>("voxels", "surface voxels");
    if (showsLight())
        irradiance_ =
            builder.read<VoxelIrradiance>("irradiance", "light that arrives at the voxels' surfaces");
    final_ = builder.write<FrameImage>("final", "voxels, as cubes");
}

void ShowVoxels::plan(PassPlan& plan) {
    plan.image(plan.get(final_).image, "voxels", frameImageDesc(plan.frame));
    march_.plan(plan, plan.get(voxels_));
    if (showsLight())
        plan.reserve("face irradiance (estimated)", FaceIrradiance::bytes(plan.get(voxels_).voxelCount));
}

void ShowVoxels::prepare(PassSetup& setup) {
    march_.prepare(setup.device, setup.compiler);
    Defines defines = march_.defines();
    if (showsLight()) {
        defines.emplace("SHOW_IRRADIANCE", "1");
        faces_ = FaceIrradiance(setup.device, setup.compiler);
    }
    program_ = makeComputeProgram(setup.device,
                                  setup.compiler.compile("passes/show_voxels/show_voxels.comp", defines));
    facesVersion_.reset();
}

void ShowVoxels::record(PassContext& context) {
    const SurfaceVoxels& voxels = context.get(voxels_);
    march_.begin(context.stream, voxels);
    std::vector<Binding> bindings = march_.bindings();
    bindings.emplace_back("result", context.get(final_).image);
    if (showsLight()) {
        const VoxelIrradiance& light = context.get(irradiance_);
        if (const std::pair version{voxels.version, light.version}; facesVersion_ != version) {
            faces_.update(context.stream, voxels, light.area, light.indirect, &light.direct);
            facesVersion_ = version;
        }
        bindings.emplace_back("faceIrradiance", faces_.buffer());
    } else {
        bindings.emplace_back("VoxelMaterialsAt", voxels.materials.at());
    }
    const Frame& frame = context.frame;
    const CameraRays camera = cameraRays(frame.camera, frame.width, frame.height);
    context.stream.dispatch(
        program_, bindings,
        Push{voxels.grid, camera.origin, camera.forward, camera.right, camera.up, uint32_t(params_.show)},
        pixelGroups(frame.width, frame.height));
    context.voxelCounts.push_back(&march_.counts());
}

}  // namespace voxray
