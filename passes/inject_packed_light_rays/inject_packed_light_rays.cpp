#include "passes/inject_packed_light_rays/inject_packed_light_rays.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/error.h"
#include "passes/common/compute/dispatch.h"
#include "passes/common/lights/light_sources.h"

namespace voxray {
namespace {

constexpr uint32_t kMaxPackedBatchRays = 1u
                                         << 20;  // Bounds the memory of rays and what they carry to 60 MiB.
constexpr float kNearest = 0.02f;                // m; no hit is nearer (listing 7.7).

struct GridRaysPush {
    uint32_t light;
    uint32_t raysPerEdge;
    uint32_t firstRay;
    uint32_t batchRays;
    float nearest;
};

struct DepositPush {
    gpu::VoxelGrid grid;
    uint32_t batchRays;
    uint32_t isLast;
    float white;
    float nearest;
};

/// The number of the scene's only light. @throws Error where it is none, or not a spot light.
uint32_t spotLight(const SceneState& scene) {
    const std::vector<LightSource> sources = requireLightSources(scene, InjectPackedLightRays::kName);
    const LightSource& first = sources.front();
    if (sources.size() > 1 || first.kind != LightSource::Punctual ||
        scene.lights[first.light].type != LightType::Spot)
        throw Error("{}: it takes one spot light and no other light, as published",
                    InjectPackedLightRays::kName);
    return first.light;
}

}  // namespace

void InjectPackedLightRays::declare(PassBuilder& builder) {
    voxels_ = builder.read<PackedVoxels>("packed_voxels", "normals and albedos, one word a voxel");
    light_ = builder.write<PackedLight>("packed_light", "light that arrives in voxels, one word a voxel");
}

void InjectPackedLightRays::plan(PassPlan& plan) {
    spotLight(*plan.frame.scene);
    raysPerEdge_ = uint32_t(std::lround(std::sqrt(double(params_.raysPerLight))));
    if (raysPerEdge_ * raysPerEdge_ != params_.raysPerLight)
        throw Error("{}: rays_per_light: {} is no square of a whole number; the nearest is {}", kName,
                    params_.raysPerLight, raysPerEdge_ * raysPerEdge_);

    PackedLight& light = plan.get(light_);
    light.white = params_.white;
    light.lightBounces = params_.bounces;
    plan.buffer(light.irradiance, "packed irradiance", plan.get(voxels_).bytes());
    const uint64_t batch = std::min(params_.raysPerLight, kMaxPackedBatchRays);
    plan.scratchBuffer(rays_, "light rays", batch * sizeof(Ray));
    plan.scratchBuffer(hits_, "light ray hits", batch * sizeof(Hit));
    tint_.plan(plan, batch);
    plan.scratchBuffer(intensities_, "intensities of light rays", batch * sizeof(glm::vec3));
}

void InjectPackedLightRays::prepare(PassSetup& setup) {
    const auto program = [&](const char* file, const Defines& defines = {}) {
        return makeComputeProgram(setup.device, setup.compiler.compile(file, defines));
    };
    tint_.prepare(setup);
    gridRays_ = program("passes/inject_packed_light_rays/grid_rays.comp");
    deposit_ = program("passes/inject_packed_light_rays/deposit.comp", params_.defines());
}

void InjectPackedLightRays::record(PassContext& context) {
    CommandStream& stream = context.stream;
    const PackedVoxels& voxels = context.get(voxels_);
    const PackedLight& light = context.get(light_);
    const uint32_t number = spotLight(*context.frame.scene);
    stream.fill(light.irradiance, 0);
    for (uint32_t first = 0; first < params_.raysPerLight; first += kMaxPackedBatchRays) {
        const uint32_t count = std::min(kMaxPackedBatchRays, params_.raysPerLight - first);
        stream.dispatch(gridRays_, context.scene.bindings({{"rays", rays_}, {"intensities", intensities_}}),
                        GridRaysPush{number, raysPerEdge_, first, count, kNearest}, linearGroups(count));
        for (uint32_t bounce = 0; bounce <= params_.bounces; ++bounce) {
            context.tracer.closestHit(stream, rays_, hits_, count,
                                      bounce == 0 ? Coherence::Coherent : Coherence::Incoherent);
            if (bounce == 0) tint_.apply(context, rays_, intensities_, 3, count, &hits_);
            stream.dispatch(deposit_,
                            {{"rays", rays_},
                             {"intensities", intensities_},
                             {"hits", hits_},
                             {"NormalsAt", voxels.normals.at()},
                             {"AlbedosAt", voxels.albedos.at()},
                             {"IrradianceAt", light.irradiance.at()}},
                            DepositPush{voxels.grid, count, bounce == params_.bounces, light.white, kNearest},
                            linearGroups(count));
        }
    }
}

}  // namespace voxray
