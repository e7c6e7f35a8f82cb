#include "passes/inject_camera_rays/inject_camera_rays.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <numbers>

#include "passes/common/compute/dispatch.h"
#include "passes/common/compute/random_seed.h"
#include "scene/camera_rays.h"

namespace voxray {
namespace {

constexpr uint32_t kCameraBatchRays = 1u << 18;
constexpr uint64_t kPathIrradianceBytes = 4 * sizeof(float);  // Of a surfel.

struct ArrivePush {
    gpu::VoxelGrid grid;
    uint32_t rayCount;
    uint32_t firstId;
    glm::vec3 forward;
    float imageArea;
    float maxArea;
};

}  // namespace

void InjectCameraRays::declare(PassBuilder& builder) {
    voxels_ = builder.read<SurfaceVoxels>("voxels", "surface voxels to light");
    irradiance_ = builder.write<VoxelIrradiance>("irradiance", "light that arrives at the voxels' surfaces");
}

void InjectCameraRays::plan(PassPlan& plan) {
    plan.get(irradiance_).lightBounces = params_.bounces;
    sources_ = requireLightSources(*plan.frame.scene, kName);
    const uint32_t batch = std::min(params_.raysPerImage, kCameraBatchRays);
    injection_.plan(plan, kName, params_, {batch, false, true, params_.lightSamples}, plan.get(voxels_));
    plan.buffer(rays_, "camera rays", batch * sizeof(Ray));
    plan.buffer(hits_, "camera hits", batch * sizeof(Hit));
    plan.buffer(count_, "number of surfels", sizeof(uint32_t));
    for (LitSurfels* lit : {&first_, &second_}) {
        plan.buffer(lit->surfels, "surfels at hits", batch * sizeof(gpu::Surfel));
        plan.buffer(lit->direct, "direct irradiance at hits", batch * kPathIrradianceBytes);
        plan.buffer(lit->indirect, "indirect irradiance at hits", batch * kPathIrradianceBytes);
    }
}

void InjectCameraRays::prepare(PassSetup& setup) {
    injection_.prepare(setup);
    imageRays_.prepare(setup);
    arrive_ =
        makeComputeProgram(setup.device, setup.compiler.compile("passes/inject_camera_rays/arrive.comp"));
}

void InjectCameraRays::record(PassContext& context) {
    const PathScene scene{context.get(voxels_), sources_};
    injection_.begin(context, scene, context.get(irradiance_));
    for (uint32_t first = 0; first < params_.raysPerImage; first += kCameraBatchRays) {
        emit(context, first, std::min(kCameraBatchRays, params_.raysPerImage - first));
        if (first_.count > 0) light(context, scene);
    }
    injection_.finish(context, scene.voxels, context.get(irradiance_));
}

void InjectCameraRays::emit(PassContext& context, uint32_t firstRay, uint32_t rays) {
    const gpu::VoxelGrid& grid = context.get(voxels_).grid;
    const CameraRays camera = cameraRays(context.frame.camera, context.frame.width, context.frame.height);
    CommandStream& stream = context.stream;
    imageRays_.record(context, rays_, firstRay, rays, randomSeed(context.frame, context.frameIndex));
    context.tracer.closestHit(stream, rays_, hits_, rays);

    const double surfaces = surfaceArea(context.frame.scene->geometry);
    const double face = double(grid.voxelSize) * grid.voxelSize;
    stream.fill(count_, 0);
    stream.dispatch(arrive_,
                    context.get(voxels_).bindings(context.scene.bindings(
                        {{"rays", rays_}, {"hits", hits_}, {"surfels", first_.surfels}, {"count", count_}})),
                    ArrivePush{grid, rays, firstRay, camera.forward,
                               float(4 * glm::length(camera.right) * glm::length(camera.up) / surfaces),
                               float(std::numbers::sqrt2 * face * params_.raysPerImage / surfaces)},
                    linearGroups(rays));
    first_.count = stream.readAs<uint32_t>(count_, 1)[0];
}

void InjectCameraRays::light(PassContext& context, const PathScene& scene) {
    SurfelPaths& paths = injection_.paths();
    CommandStream& stream = context.stream;
    const uint32_t seed = randomSeed(context.frame, context.frameIndex);

    // The first surfels, and one ray on from each to the second ones.
    paths.measure(context, scene, first_.surfels, first_.count, seed, first_.direct);
    paths.begin(context, first_.surfels, first_.count, seed, first_.indirect);
    paths.extend(context, scene, first_.indirect, SurfelPaths::Normals::Geometric);
    if (params_.bounces == 0) stream.fill(first_.indirect, 0);
    second_.count = paths.count();
    if (second_.count > 0) {
        stream.copy(paths.ends(), second_.surfels, second_.count * sizeof(gpu::Surfel));
        stream.copy(paths.direct(), second_.direct, second_.count * kPathIrradianceBytes);

        // Paths on from the second ones. Their last bounce would be one too many for the first ones.
        paths.begin(context, second_.surfels, second_.count, seed + 0x2545f491u, second_.indirect);
        for (uint32_t bounce = 1; bounce <= params_.bounces; ++bounce) {
            if (bounce == params_.bounces)
                paths.reflect(context, second_.surfels, second_.count, second_.indirect, first_.indirect);
            paths.extend(context, scene, second_.indirect);
        }
        injection_.write(context, second_.surfels, second_.count, second_.direct, second_.indirect);
    }
    injection_.write(context, first_.surfels, first_.count, first_.direct, first_.indirect);
}

}  // namespace voxray
