#include "passes/inject/light_paths/light_paths.h"

#include <algorithm>

#include "base/error.h"
#include "passes/inject/light_paths/light_path_types.h"

namespace voxray {
namespace {

/// Merging irradiances needs rays with a known cross-section.
void checkBeams(const std::string& pass, const LightPathParams& params, const std::vector<LightSource>& sources) {
    const std::string write = enumName(params.write);
    const bool isDiffuse = params.secondary == Secondary::Diffuse || params.secondary == Secondary::Material;
    if (isDiffuse && params.bounces > 0)
        throw Error(
            "{}: 'write: {}' merges irradiances, and a diffusely reflected ray has none, only power; use 'secondary: "
            "mirror' or 'none', or 'write: average'",
            pass, write);
    for (const LightSource& source : sources)
        if (source.kind != LightSource::Punctual)
            throw Error(
                "{}: 'write: {}' merges irradiances, and a ray from {} has none, only power; use 'write: "
                "average', or point, spot and directional lights alone",
                pass, write, source.kind == LightSource::Emitters ? "an emissive surface" : "the environment");
}

}  // namespace

LightPaths::LightPaths(ProgramOwner& owner, const LightPathParams& params)
    : params_(params),
      sumsFlux_(params.write == Write::Average),
      generateOcclusionRays_(owner, "passes/surfels/generate_occlusion_rays.comp"),
      deposit_(owner, "deposit_light.comp",
               sumsFlux_ ? Defines{{"FLUX", "1"}} : VoxelAccumulator::defines(params.write)),
      unoccludedArea_(owner, "passes/common/voxels/unoccluded_area.comp"),
      paneTransmittance_(owner) {
    for (size_t i = 0; i < accumulatorCount(); ++i) {
        if (sumsFlux_)
            fluxes_[i].emplace(owner);
        else
            irradiances_[i].emplace(owner, params_);
    }
}

void LightPaths::plan(PassPlan& plan, const std::string& pass, uint32_t batch, const VoxelLevels& voxels,
                      const std::vector<LightSource>& sources) {
    deposit_.specialize({{"kSecondary", uint32_t(params_.secondary)}, {"kCaustics", params_.caustics}});
    if (!isResource<SurfaceVoxels>(voxels))
        for (Kernel* kernel : {&generateOcclusionRays_, &deposit_}) kernel->define({{"VOXEL_LEVELS", "1"}});
    if (sumsFlux_) {
        if (!plan.device.shaderInt64Atomics)
            throw Error("{}: device '{}' lacks 64-bit atomics on buffers (shaderBufferInt64Atomics)", pass,
                        plan.device.name);
    } else {
        checkBeams(pass, params_, sources);
        if (!isResource<SurfaceVoxels>(voxels))
            throw Error("{}: 'write: {}' needs the voxels of one grid ('voxelize'); in a clipmap use 'write: average'",
                        pass, enumName(params_.write));
        VoxelAccumulator::plan(plan, pass, params_);
    }
    plan.scratchBuffer(rays_, "light rays", batch * sizeof(Ray));
    plan.scratchBuffer(hits_, "light ray hits", batch * sizeof(Hit));
    plan.scratchBuffer(paths_, "light paths", batch * sizeof(gpu::LightPath));
    paneTransmittance_.plan(plan, batch);
    plan.scratchBuffer(occlusionRays_, "visibility rays", batch * sizeof(Ray));
    plan.scratchBuffer(occluded_, "visibility results", batch * sizeof(uint32_t));
    plan.estimate(voxels.estimatedCount * VoxelIrradiance::bytes(1));
}

void LightPaths::begin(PassContext& context, const VoxelLevels& voxels, const std::vector<LightSource>& sources) {
    const double power = totalPower(sources);
    const float typical = meanIrradiance(sources, context.frame.scene->geometry);
    for (size_t i = 0; i < accumulatorCount(); ++i) {
        if (sumsFlux_)
            fluxes_[i]->begin(context.device, context.stream, voxels, power);
        else
            irradiances_[i]->begin(context.device, context.stream, voxels, typical);
    }
    context.stream.fill(occluded_, 0);
}

void LightPaths::trace(PassContext& context, const VoxelLevels& voxels, const Batch& batch) {
    CommandStream& stream = context.stream;
    for (uint32_t bounce = 0; bounce <= params_.lastBounce(); ++bounce) {
        if (bounce > 0 || !batch.hasFirstHits) context.tracer.closestHit(stream, rays_, hits_, batch.count);
        if (bounce == 0)
            paneTransmittance_.apply(context, rays_, paths_, sizeof(gpu::LightPath) / sizeof(float), batch.count,
                                     &hits_);

        // Occlusion of the hits, where only unoccluded area counts
        if (voxels.areasAreUnoccluded) {
            stream.dispatch(generateOcclusionRays_, batch.count,
                            {context.scene,
                             voxels,
                             {"rays", rays_},
                             {"hits", hits_},
                             {"occlusionRays", occlusionRays_},
                             {"rayCount", batch.count},
                             ifUsed({"voxelSize", voxels.grid.voxelSize})});
            context.tracer.occluded(stream, occlusionRays_, occluded_, batch.count);
        }

        // Deposit and scatter
        const size_t target = bounce == 0 ? 0 : 1;
        stream.dispatch(deposit_, batch.count,
                        {context.scene,
                         voxels,
                         sumsFlux_ ? fluxes_[target]->bindings() : irradiances_[target]->bindings(),
                         {"scale", sumsFlux_ ? fluxes_[target]->unitsPerWatt() : irradiances_[target]->scale()},
                         {"rays", rays_},
                         {"hits", hits_},
                         {"paths", paths_},
                         {"occluded", occluded_},
                         {"firstRay", batch.first},
                         {"batchRays", batch.count},
                         {"seed", batch.seed},
                         {"bounce", bounce},
                         {"lastBounce", params_.lastBounce()},
                         ifUsed({"grid", voxels.grid})});
    }
}

void LightPaths::finish(PassContext& context, const VoxelLevels& voxels, VoxelIrradiance& irradiance) {
    CommandStream& stream = context.stream;
    irradiance.allocate(context.device, voxels.voxelCount);

    // Faces that no ray hit are dark, not unknown
    const auto* surfaces = dynamic_cast<const SurfaceVoxels*>(&voxels);
    if (surfaces)
        stream.dispatch(unoccludedArea_, voxels.voxelCount,
                        {*surfaces, {"area", irradiance.area}, {"voxelCount", voxels.voxelCount}});
    else
        stream.copy(voxels.unoccludedArea, irradiance.area, irradiance.area.bytes());
    const auto resolve = [&](size_t i, const LargeBuffer& flux) {
        if (sumsFlux_)
            fluxes_[i]->resolve(stream, voxels, flux);
        else
            irradiances_[i]->resolve(stream, *surfaces, flux, irradiance.area);
    };
    resolve(0, irradiance.direct);
    if (params_.lastBounce() > 0)
        resolve(1, irradiance.indirect);
    else
        stream.fill(irradiance.indirect, 0);

    stream.finish();
    for (size_t i = 0; i < accumulatorCount(); ++i) {
        if (sumsFlux_)
            fluxes_[i]->end();
        else
            irradiances_[i]->end();
    }

    requireLight(stream, voxels, irradiance, *context.frame.scene);
}

}  // namespace voxray
