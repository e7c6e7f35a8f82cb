#include "passes/show_voxels/show_voxels.h"

#include "base/error.h"
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
    uint32_t redAt;
};

struct LevelPush {
    glm::vec3 origin;
    glm::vec3 forward;
    glm::vec3 right;  ///< From the image's center to its edge, at a distance of 1.
    glm::vec3 up;
    uint32_t level;
    uint32_t showsOpacity;
};

}  // namespace

void ShowVoxels::declare(PassBuilder& builder) {
    if (showsLevel())
        radiance_ = builder.read<RadianceVoxels>("radiance", "light that leaves surfaces, at all scales");
    else
        voxels_ = builder.read<SurfaceVoxels>("voxels", "surface voxels");
    if (showsLight())
        irradiance_ =
            builder.read<VoxelIrradiance>("irradiance", "light that arrives at the voxels' surfaces");
    if (showsLitFaces()) {
        patches_ = builder.read<VoxelPatches>("patches", "surfaces by the open space that they look into");
        visibility_ = builder.read<ClusterVisibility>("cluster_visibility", "what each patch sees");
        clusterLight_ = builder.read<ClusterLight>("cluster_light", "which patches are lit");
    }
    final_ = builder.write<FrameImage>("final", "voxels, as cubes");
}

void ShowVoxels::plan(PassPlan& plan) {
    plan.image(plan.get(final_).image, "voxels", frameImageDesc(plan.frame));
    if (showsLevel()) {
        const uint32_t levels = plan.get(radiance_).grid.levels;
        if (params_.level >= levels)
            throw Error("show_voxels.level: there is no level {}; the radiance voxels have 0 to {}",
                        params_.level, levels - 1);
        return;
    }
    march_.plan(plan, plan.get(voxels_));
    if (showsLight())
        plan.reserve("face irradiance (estimated)", FaceIrradiance::bytes(plan.get(voxels_).voxelCount));
    if (showsLitFaces()) plan.reserve("lit faces (estimated)", LitFaces::bytes(plan.get(voxels_).voxelCount));
}

void ShowVoxels::prepare(PassSetup& setup) {
    if (showsLevel()) {
        program_ = makeComputeProgram(
            setup.device,
            setup.compiler.compile("passes/show_voxels/show_levels.comp", setup.get(radiance_).defines()));
        return;
    }
    march_.prepare(setup.device, setup.compiler);
    Defines defines = march_.defines();
    if (showsLight()) {
        defines.emplace("SHOW_IRRADIANCE", "1");
        faces_ = FaceIrradiance(setup.device, setup.compiler);
    }
    if (showsLitFaces()) {
        defines.emplace("SHOW_LIT_FACES", "1");
        litFaces_.prepare(setup);
    }
    program_ = makeComputeProgram(setup.device,
                                  setup.compiler.compile("passes/show_voxels/show_voxels.comp", defines));
    facesVersion_.reset();
}

void ShowVoxels::record(PassContext& context) {
    if (showsLevel()) return recordLevel(context);
    const SurfaceVoxels& voxels = context.get(voxels_);
    march_.begin(context.stream, voxels);
    std::vector<Binding> bindings = march_.bindings();
    bindings.emplace_back("result", context.get(final_).image);
    bindings.push_back(faces(context));
    const Frame& frame = context.frame;
    const CameraRays camera = cameraRays(frame.camera, frame.width, frame.height);
    context.stream.dispatch(program_, bindings,
                            Push{voxels.grid, camera.origin, camera.forward, camera.right, camera.up,
                                 uint32_t(params_.show), params_.redAt},
                            pixelGroups(frame.width, frame.height));
    context.voxelCounts.push_back(&march_.counts());
}

Binding ShowVoxels::faces(PassContext& context) {
    const SurfaceVoxels& voxels = context.get(voxels_);
    const auto isNew = [&](uint64_t of, uint64_t light) {
        const std::pair version{of, light};
        return std::exchange(facesVersion_, version) != version;
    };
    if (showsLight()) {
        const VoxelIrradiance& light = context.get(irradiance_);
        if (isNew(voxels.version, light.version))
            faces_.update(context.stream, voxels, light.area, light.indirect, &light.direct);
        return faces_.binding();
    }
    if (showsLitFaces()) {
        const ClusterVisibility& visibility = context.get(visibility_);
        const ClusterLight& light = context.get(clusterLight_);
        if (isNew(visibility.version, light.version))
            litFaces_.count(context.stream, voxels.voxelCount, context.get(patches_), visibility, light);
        return {"seenByFaces", litFaces_.seenByFaces()};
    }
    return {"VoxelMaterialsAt", voxels.materials.at()};
}

void ShowVoxels::recordLevel(PassContext& context) {
    const Frame& frame = context.frame;
    const CameraRays camera = cameraRays(frame.camera, frame.width, frame.height);
    std::vector<Binding> bindings = context.get(radiance_).bindings();
    bindings.emplace_back("result", context.get(final_).image);
    context.stream.dispatch(program_, bindings,
                            LevelPush{camera.origin, camera.forward, camera.right, camera.up, params_.level,
                                      params_.show == ShownValue::RadianceOpacity},
                            pixelGroups(frame.width, frame.height));
}

}  // namespace voxray
