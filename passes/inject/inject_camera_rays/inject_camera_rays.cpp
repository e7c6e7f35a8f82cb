#include <algorithm>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "graph/registry.h"
#include "passes/common/compute/random_seed.h"
#include "passes/common/view/image_rays.h"
#include "passes/surfels/surfel_injection.h"
#include "scene/camera_rays.h"
#include "scene/region_split.h"

namespace voxray {

/// Measures irradiance at the hits of camera rays, and of one diffuse ray from each, by shadow rays and
/// paths, and writes it to the voxels of the hits. Source: Magalhães 2020, section 3.3.2 (described there,
/// not built).
class InjectCameraRays final : public Pass {
 public:
    static constexpr const char* kName = "inject_camera_rays";
    static constexpr const char* kHelp =
        "Lights voxels by shadow rays at the hits of rays from the camera. "
        "Shadow rays measure the irradiance at these hits and at those of one diffuse ray from each. "
        "Each hit counts by the area that it stands for. "
        "Leaves unlit: what neither the view nor its secondary rays reach. "
        "Biased by: voxel size; partly visible voxels take the irradiance of their visible part. "
        "Noisy by: rays_per_image. Source: Magalhães 2020, section 3.3.2.";
    struct Params : WriteParams {
        uint32_t raysPerImage = 1048576;
        uint32_t bounces = 8;
        uint32_t lightSamples = 1;
        static constexpr auto schema() {
            return std::tuple_cat(
                WriteParams::schema(),
                std::tuple{
                    field("rays_per_image", &Params::raysPerImage, "Rays from the camera.", 1u, 1u << 26).lessNoise(),
                    field("bounces", &Params::bounces, "Bounces of light; Russian roulette by albedo ends paths early.",
                          0u, 32u),
                    field("light_samples", &Params::lightSamples,
                          "Shadow rays at each hit to the emissive surfaces, and to the environment.", 1u, 64u)});
        }
    };

    explicit InjectCameraRays(const Params& params) : params_(params) {}
    Phase phase() const override { return Phase::Frame; }
    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    /// A batch of surfels with their irradiance, W/m².
    struct LitSurfels {
        Buffer surfels, direct, indirect;
        uint32_t count = 0;
    };
    /// Traces camera rays, and makes surfels of their hits.
    void traceCameraRays(PassContext& context, uint32_t firstRay, uint32_t rays);
    /// Extends paths from these surfels, and writes irradiance to the voxels.
    void inject(PassContext& context, const PathScene& scene);

    static constexpr uint32_t kMaxBatchRays = 1u << 18;
    static constexpr uint64_t kIrradianceBytes = 4 * sizeof(float);  ///< Of a surfel.

    const Params params_;
    In<SurfaceVoxels> voxels_{*this, "voxels", "surface voxels to light"};
    Out<VoxelIrradiance> irradiance_{*this, "irradiance", "light that arrives at the voxels' surfaces"};
    SurfelInjection injection_{*this};
    SurfelPaths paths_{*this};
    ImageRays imageRays_{*this};
    Kernel surfelsAtHits_{*this, "surfels_at_hits.comp"};
    Buffer rays_, hits_, count_;
    LitSurfels first_, second_;  ///< At the hits of camera rays, and of a diffuse ray from each.
};

void InjectCameraRays::plan(PassPlan& plan) {
    plan[irradiance_].lightBounces = params_.bounces;
    requireLightSources(*plan.frame.scene, kName);
    const uint32_t batch = std::min(params_.raysPerImage, kMaxBatchRays);
    injection_.plan(plan, kName, params_, plan[voxels_]);
    paths_.plan(plan, batch, params_.lightSamples, true);
    plan.buffer(rays_, "camera rays", batch * sizeof(Ray));
    plan.buffer(hits_, "camera hits", batch * sizeof(Hit));
    plan.buffer(count_, "number of surfels", sizeof(uint32_t));
    for (LitSurfels* lit : {&first_, &second_}) {
        plan.buffer(lit->surfels, "surfels at hits", batch * sizeof(gpu::Surfel));
        plan.buffer(lit->direct, "direct irradiance at hits", batch * kIrradianceBytes);
        plan.buffer(lit->indirect, "indirect irradiance at hits", batch * kIrradianceBytes);
    }
}

void InjectCameraRays::record(PassContext& context) {
    const std::vector<LightSource> sources = lightSources(*context.frame.scene);  // Emissive surfaces may grow
    const PathScene scene{context[voxels_], sources};
    injection_.begin(context, scene, context[irradiance_]);
    for (uint32_t first = 0; first < params_.raysPerImage; first += kMaxBatchRays) {
        traceCameraRays(context, first, std::min(kMaxBatchRays, params_.raysPerImage - first));
        if (first_.count > 0) inject(context, scene);
    }
    injection_.finish(context, scene.voxels, context[irradiance_]);
}

void InjectCameraRays::traceCameraRays(PassContext& context, uint32_t firstRay, uint32_t rays) {
    const CameraRays camera = cameraRays(context.frame.camera, context.frame.width, context.frame.height);
    CommandStream& stream = context.stream;
    imageRays_.record(context, rays_, firstRay, rays, randomSeed(context.frame, context.frameIndex));
    context.tracer.closestHit(stream, rays_, hits_, rays);

    const double surfaces = surfaceArea(context.frame.scene->geometry);
    const float voxelSize = context[voxels_].grid.voxelSize;
    const double face = double(voxelSize) * voxelSize;
    stream.fill(count_, 0);
    context.dispatch(surfelsAtHits_, rays,
                     {context.scene,
                      context[voxels_],
                      {"rays", rays_},
                      {"hits", hits_},
                      {"surfels", first_.surfels},
                      {"count", count_},
                      {"rayCount", rays},
                      {"firstId", firstRay},
                      {"forward", camera.forward},
                      {"imageArea", float(4 * glm::length(camera.right) * glm::length(camera.up) / surfaces)},
                      {"maxArea", float(std::numbers::sqrt2 * face * params_.raysPerImage / surfaces)}});
    first_.count = stream.readAs<uint32_t>(count_, 1)[0];
}

void InjectCameraRays::inject(PassContext& context, const PathScene& scene) {
    CommandStream& stream = context.stream;
    const uint32_t seed = randomSeed(context.frame, context.frameIndex);

    // Direct light of the first surfels, and a ray from each to the second ones
    paths_.measureDirect(context, scene, first_.surfels, first_.count, seed, first_.direct);
    paths_.init(context, first_.surfels, first_.count, seed, first_.indirect);
    paths_.extend(context, scene, first_.indirect, SurfelPaths::Normals::Geometric);
    if (params_.bounces == 0) stream.fill(first_.indirect, 0);
    second_.count = paths_.count();
    if (second_.count > 0) {
        stream.copy(paths_.vertices(), second_.surfels, second_.count * sizeof(gpu::Surfel));
        stream.copy(paths_.direct(), second_.direct, second_.count * kIrradianceBytes);

        // Paths from the second ones. Their last bounce would be one too many for the first ones
        paths_.init(context, second_.surfels, second_.count, seed + 0x2545f491u, second_.indirect);
        for (uint32_t bounce = 1; bounce <= params_.bounces; ++bounce) {
            if (bounce == params_.bounces)
                paths_.accumulate(context, second_.surfels, second_.count, second_.indirect, first_.indirect);
            paths_.extend(context, scene, second_.indirect);
        }
        injection_.writeDirect(context, second_.surfels, second_.count, second_.direct);
        injection_.writeIndirect(context, second_.surfels, second_.count, second_.indirect);
    }
    injection_.writeDirect(context, first_.surfels, first_.count, first_.direct);
    injection_.writeIndirect(context, first_.surfels, first_.count, first_.indirect);
}

VOXRAY_REGISTER_PASS(InjectCameraRays);

}  // namespace voxray
