#include "passes/inject_camera_rays/inject_camera_rays.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <numbers>

#include "passes/common/compute/random_seed.h"
#include "scene/camera_rays.h"

namespace voxray {
namespace {

constexpr uint32_t kBatchRays = 1u << 18;  // Bounds the memory of paths to 20 MiB a bounce.

}  // namespace

void InjectCameraRays::declare(PassBuilder& builder) {
    voxels_ = builder.read<SurfaceVoxels>("voxels", "surface voxels to light");
    irradiance_ = builder.write<VoxelIrradiance>("irradiance", "light that arrives at the voxels' surfaces");
}

void InjectCameraRays::plan(PassPlan& plan) {
    sources_ = requireLightSources(*plan.frame.scene, kName);
    const SurfaceVoxels& voxels = plan.get(voxels_);
    plan.reserve("voxel samples (estimated)", 2 * VoxelAccumulator::plan(plan, kName, params_, voxels));
    plan.reserve("irradiance (estimated)", VoxelIrradiance::bytes(voxels.voxelCount));
    const uint32_t batch = std::min(params_.raysPerImage, kBatchRays);
    paths_.plan(plan, {params_.write, batch, params_.bounces, params_.lightSamples, true});
    plan.buffer(rays_, "camera rays", batch * sizeof(Ray));
    plan.buffer(hits_, "camera hits", batch * sizeof(Hit));
}

void InjectCameraRays::prepare(PassSetup& setup) {
    paths_.prepare(setup);
    direct_ = VoxelAccumulator(setup.device, setup.compiler, params_);
    indirect_ = VoxelAccumulator(setup.device, setup.compiler, params_);
    imageRays_.prepare(setup);
}

void InjectCameraRays::record(PassContext& context) {
    const SurfaceVoxels& voxels = context.get(voxels_);
    VoxelIrradiance& irradiance = context.get(irradiance_);
    CommandStream& stream = context.stream;
    irradiance.allocate(context.device, voxels.voxelCount);
    stream.fill(irradiance.area, 0);
    const float typical = meanIrradiance(sources_, context.frame.scene->geometry);
    direct_.begin(context.device, stream, voxels, typical);
    indirect_.begin(context.device, stream, voxels, typical);

    const CameraRays camera = cameraRays(context.frame.camera, context.frame.width, context.frame.height);
    const double surfaces = surfaceArea(context.frame.scene->geometry);
    const double face = double(voxels.grid.voxelSize) * voxels.grid.voxelSize;
    const SurfelPaths::CameraFootprint footprint{
        camera.forward, float(4 * glm::length(camera.right) * glm::length(camera.up) / surfaces),
        float(std::numbers::sqrt2 * face * params_.raysPerImage / surfaces)};
    const uint32_t seed = randomSeed(context.frame, context.frameIndex);
    for (uint32_t first = 0; first < params_.raysPerImage; first += kBatchRays) {
        const uint32_t batch = std::min(kBatchRays, params_.raysPerImage - first);
        imageRays_.record(context, rays_, first, batch, seed);
        context.tracer.closestHit(stream, rays_, hits_, batch);
        const uint32_t count = paths_.arrive(context, voxels, footprint, rays_, hits_, batch, first);
        if (count > 0) paths_.run(context, sources_, count, seed, {voxels, direct_, indirect_});
    }

    direct_.resolve(stream, voxels, irradiance.direct, irradiance.area);
    indirect_.resolve(stream, voxels, irradiance.indirect, irradiance.area);
    stream.finish();
}

}  // namespace voxray
