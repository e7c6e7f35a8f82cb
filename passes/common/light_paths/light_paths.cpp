#include "passes/common/light_paths/light_paths.h"

#include <algorithm>

#include "base/error.h"
#include "passes/common/compute/dispatch.h"
#include "shaders/light_paths/light_path_types.h"

namespace voxray {
namespace {

struct VisibilityPush {
    uint32_t batchRays;
    float voxelSize;
};

struct FollowPush {
    gpu::VoxelGrid grid;
    uint32_t firstRay;
    uint32_t batchRays;
    uint32_t seed;
    uint32_t bounce;
    uint32_t lastBounce;
    float scale;
};

// Merged irradiances need beams: light whose cross-section is known at each hit.
void checkBeams(const std::string& pass, const LightPathParams& params,
                const std::vector<LightSource>& sources) {
    const std::string write = enumName(params.write);
    const bool isDiffuse = params.secondary == Secondary::Diffuse || params.secondary == Secondary::Material;
    if (isDiffuse && params.bounces > 0)
        throw Error(
            "{}: 'write: {}' merges irradiances, and a diffusely reflected ray has none, only power; use "
            "'secondary: mirror' or 'none', or 'write: average'",
            pass, write);
    for (const LightSource& source : sources)
        if (source.kind != LightSource::Punctual)
            throw Error(
                "{}: 'write: {}' merges irradiances, and a ray from {} has none, only power; use 'write: "
                "average', or point, spot and directional lights alone",
                pass, write,
                source.kind == LightSource::Emitters ? "an emissive surface" : "the environment");
}

}  // namespace

void LightPaths::plan(PassPlan& plan, const std::string& pass, const LightPathParams& params, uint32_t batch,
                      const SurfaceVoxels& voxels, const std::vector<LightSource>& sources) {
    params_ = params;
    sumsFlux_ = params.write == Write::Average;
    const bool indirect = params.lastBounce() > 0;
    if (sumsFlux_) {
        if (!plan.device.shaderInt64Atomics)
            throw Error("{}: device '{}' lacks 64-bit atomics on buffers (shaderBufferInt64Atomics)", pass,
                        plan.device.name);
        plan.reserveScratch("flux accumulator (estimated)", (indirect ? 2 : 1) * uint64_t(voxels.voxelCount) *
                                                                FluxAccumulator::kBytesPerVoxel);
    } else {
        checkBeams(pass, params, sources);
        plan.reserveScratch("voxel samples (estimated)",
                            (indirect ? 2 : 1) * VoxelAccumulator::plan(plan, pass, params, voxels));
    }
    plan.scratchBuffer(rays_, "light rays", batch * sizeof(Ray));
    plan.scratchBuffer(hits_, "light ray hits", batch * sizeof(Hit));
    plan.scratchBuffer(paths_, "light paths", batch * sizeof(gpu::LightPath));
    tint_.plan(plan, batch);
    plan.scratchBuffer(visibilityRays_, "visibility rays", batch * sizeof(Ray));
    plan.scratchBuffer(hidden_, "visibility results", batch * sizeof(uint32_t));
    plan.reserve("irradiance (estimated)", VoxelIrradiance::bytes(voxels.voxelCount));
}

void LightPaths::prepare(PassSetup& setup) {
    const auto compile = [&](const char* file, const Defines& defines = {}) {
        return setup.compiler.compile(file, defines);
    };
    visibility_ =
        makeComputeProgram(setup.device, compile("passes/common/light_paths/light_paths_visibility.comp"));
    tint_.prepare(setup);
    follow_ = makeComputeProgram(
        setup.device,
        compile("passes/common/light_paths/light_paths_follow.comp",
                sumsFlux_ ? Defines{{"FLUX", "1"}} : VoxelAccumulator::defines(params_.write)),
        {{"kSecondary", uint32_t(params_.secondary)}, {"kCaustics", params_.caustics}});
    unoccludedArea_ = makeComputeProgram(setup.device, compile("passes/common/voxels/unoccluded_area.comp"));
    for (int i = 0; i < 2; ++i) {
        if (sumsFlux_)
            fluxes_[size_t(i)] = FluxAccumulator(setup.device, setup.compiler);
        else
            irradiances_[size_t(i)] = VoxelAccumulator(setup.device, setup.compiler, params_);
    }
}

void LightPaths::begin(PassContext& context, const SurfaceVoxels& voxels,
                       const std::vector<LightSource>& sources) {
    const double power = totalPower(sources);
    const float typical = meanIrradiance(sources, context.frame.scene->geometry);
    for (size_t i = 0; i < (params_.lastBounce() > 0 ? 2 : 1); ++i) {
        if (sumsFlux_)
            fluxes_[i].begin(context.device, context.stream, voxels, power);
        else
            irradiances_[i].begin(context.device, context.stream, voxels, typical);
    }
    context.stream.fill(hidden_, 0);
}

void LightPaths::follow(PassContext& context, const SurfaceVoxels& voxels, const Batch& batch) {
    CommandStream& stream = context.stream;
    for (uint32_t bounce = 0; bounce <= params_.lastBounce(); ++bounce) {
        if (bounce > 0 || !batch.hitsKnown) context.tracer.closestHit(stream, rays_, hits_, batch.count);

        if (bounce == 0)
            tint_.apply(context, rays_, paths_, sizeof(gpu::LightPath) / sizeof(float), batch.count, &hits_);

        // Whether each hit is visible from open space, where only unoccluded area counts.
        if (voxels.unoccludedOnly) {
            stream.dispatch(visibility_,
                            context.scene.bindings(
                                {{"rays", rays_}, {"hits", hits_}, {"visibilityRays", visibilityRays_}}),
                            VisibilityPush{batch.count, voxels.grid.voxelSize}, linearGroups(batch.count));
            context.tracer.occluded(stream, visibilityRays_, hidden_, batch.count);
        }

        // Deposit and bounce.
        const size_t target = bounce == 0 ? 0 : 1;
        std::vector<Binding> bindings =
            sumsFlux_ ? fluxes_[target].bindings() : irradiances_[target].bindings();
        bindings.insert(bindings.end(),
                        {{"rays", rays_}, {"hits", hits_}, {"paths", paths_}, {"hidden", hidden_}});
        const float scale = sumsFlux_ ? fluxes_[target].unitsPerWatt() : irradiances_[target].scale();
        stream.dispatch(follow_, voxels.bindings(context.scene.bindings(bindings)),
                        FollowPush{voxels.grid, batch.first, batch.count, batch.seed, bounce,
                                   params_.lastBounce(), scale},
                        linearGroups(batch.count));
    }
}

void LightPaths::finish(PassContext& context, const SurfaceVoxels& voxels, VoxelIrradiance& irradiance) {
    CommandStream& stream = context.stream;
    irradiance.allocate(context.device, voxels.voxelCount);

    // A face that no ray met is dark, not unknown.
    stream.dispatch(unoccludedArea_, {{"VoxelMaterialsAt", voxels.materials.at()}, {"area", irradiance.area}},
                    voxels.voxelCount, linearGroups(voxels.voxelCount));
    const auto resolve = [&](size_t i, const LargeBuffer& flux) {
        if (sumsFlux_)
            fluxes_[i].resolve(stream, voxels, flux);
        else
            irradiances_[i].resolve(stream, voxels, flux, irradiance.area);
    };
    resolve(0, irradiance.direct);
    if (params_.lastBounce() > 0)
        resolve(1, irradiance.indirect);
    else
        stream.fill(irradiance.indirect, 0);

    stream.finish();
    for (FluxAccumulator& sums : fluxes_) sums.end();
    for (VoxelAccumulator& writes : irradiances_) writes.end();

    requireLight(stream, voxels, irradiance, *context.frame.scene);
}

}  // namespace voxray
