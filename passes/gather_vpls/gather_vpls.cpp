#include "passes/gather_vpls/gather_vpls.h"

#include <glm/gtc/constants.hpp>

#include "base/error.h"
#include "passes/common/compute/dispatch.h"
#include "passes/common/view/frame_image.h"
#include "passes/gather_vpls/point_maps.h"
#include "passes/gather_vpls/traced_maps.h"

namespace voxray {
namespace {

struct FinishPush {
    glm::uvec2 blocks;
    uint32_t block;
};

bool hasMaps(VplVisibility visibility) {
    return visibility == VplVisibility::ShadowMap || visibility == VplVisibility::ImperfectShadowMap;
}

bool meetsVoxels(VplVisibility visibility) {
    return !hasMaps(visibility) && visibility != VplVisibility::HybridLeaves &&
           visibility != VplVisibility::Exact && visibility != VplVisibility::None;
}

VoxelWalk walkOf(VplVisibility visibility) {
    switch (visibility) {
        case VplVisibility::SvoRestart:
            return VoxelWalk::SvoRestart;
        case VplVisibility::Bricks:
            return VoxelWalk::Bricks;
        case VplVisibility::Bits:
            return VoxelWalk::Bits;
        default:
            return VoxelWalk::Svo;
    }
}

}  // namespace

void GatherVpls::declare(PassBuilder& builder) {
    gbuffer_ = builder.read<GBuffer>("gbuffer", "what the camera sees");
    vpls_ = builder.read<Vpls>("vpls", "virtual point lights");
    if (meetsVoxels(params_.visibility)) {
        voxels_ = builder.read<SurfaceVoxels>("voxels", "what shadow rays meet");
        voxelTracer_.emplace(walkOf(params_.visibility), params_.restartEpsilon);
    }
    if (params_.visibility == VplVisibility::HybridLeaves) {
        voxels_ = builder.read<SurfaceVoxels>("voxels", "whose octree shadow rays walk through");
        leaves_ = builder.read<HybridLeaves>("hybrid_leaves", "what shadow rays meet");
        hybridTracer_.emplace(HybridWalk::Hierarchical);
    }
    noisy_ = builder.write<NoisyIrradiance>("noisy_irradiance", "irradiance from a subset of lights a texel");
    indirect_ = builder.write<FrameImage>("indirect", "radiance reflected of indirect light, unfiltered");
}

void GatherVpls::plan(PassPlan& plan) {
    const Vpls& vpls = plan.get(vpls_);
    const uint32_t samples = plan.get(gbuffer_).samples;
    const glm::uvec2 texels = gbufferExtent(plan.frame, samples);
    // The disc of that area has the squared radius area / pi. Things move without changing their area
    const float minDistanceSquared = params_.bound * params_.bound * vpls.areaPerPath / glm::pi<float>();
    const bool isCompensated = params_.compensationRays > 0 && minDistanceSquared > 0;
    if (params_.visibility == VplVisibility::ShadowMap)
        maps_ = std::make_unique<TracedMaps>(params_.mapResolution);
    if (params_.visibility == VplVisibility::ImperfectShadowMap)
        maps_ = std::make_unique<PointMaps>(params_.mapResolution, params_.mapPoints);
    if (maps_) maps_->plan(plan);
    const bool isByChance = params_.roulette > 0;
    const VplLight::Dim dim{isByChance ? params_.roulette : params_.earlyOut, isByChance};
    const float endEpsilon = params_.visibility == VplVisibility::SvoRestart ? params_.endEpsilon : 0;
    light_.plan(plan,
                {params_.block, minDistanceSquared, dim, endEpsilon, maps_.get(), isCompensated,
                 hybridTracer_.has_value()},
                texels, uint64_t(vpls.paths) * vpls.bounces);
    if (isCompensated)
        compensation_.emplace().plan(plan, {params_.compensationRays, vpls.bounces, minDistanceSquared},
                                     texels);
    NoisyIrradiance& noisy = plan.get(noisy_);
    noisy.blockSize = params_.block;
    noisy.lightBounces = plan.get(indirect_).lightBounces = vpls.lightBounces;
    plan.image(noisy.irradiance, "noisy irradiance", NoisyIrradiance::desc(plan.frame, samples));
    plan.image(sums_, "sums over virtual point lights", NoisyIrradiance::desc(plan.frame, samples));
    plan.buffer(noisy.moments, "moments of virtual point lights", noisy.momentsBytes(texels));
    if (FrameImage& indirect = plan.get(indirect_); indirect.isRead)
        plan.image(indirect.image, "indirect", frameImageDesc(plan.frame));
    if (voxelTracer_) voxelTracer_->plan(plan, plan.get(voxels_));
    if (hybridTracer_) hybridTracer_->plan(plan, plan.get(voxels_));
}

void GatherVpls::prepare(PassSetup& setup) {
    light_.prepare(setup);
    if (compensation_) compensation_->prepare(setup);
    finish_ = makeComputeProgram(setup.device, setup.compiler.compile("passes/gather_vpls/finish.comp"));
    sampler_ = texelSampler(setup.device);
    if (setup.get(indirect_).isRead) resolve_ = IrradianceResolve(setup);
    if (maps_) maps_->prepare(setup);
    if (voxelTracer_) voxelTracer_->prepare(setup.device, setup.compiler);
    if (hybridTracer_) hybridTracer_->prepare(setup.device, setup.compiler);
}

void GatherVpls::record(PassContext& context) {
    CommandStream& stream = context.stream;
    const GBuffer& gbuffer = context.get(gbuffer_);
    const Vpls& vpls = context.get(vpls_);
    const NoisyIrradiance& noisy = context.get(noisy_);
    VplLight::Visibility visibility{&context.tracer};
    if (params_.visibility == VplVisibility::None) visibility.tracer = nullptr;
    if (maps_) maps_->begin(context);
    if (voxelTracer_) {
        const SurfaceVoxels& voxels = context.get(voxels_);
        voxelTracer_->begin(stream, voxels);
        visibility = {&*voxelTracer_, voxels.grid};
    }
    if (hybridTracer_) {
        hybridTracer_->begin(stream, context.scene, context.get(voxels_), context.get(leaves_));
        hybridTracer_->setStarts(&light_.starts());
        visibility.tracer = &*hybridTracer_;
    }
    const uint64_t voxelRaysBefore = voxelTracer_ ? voxelTracer_->raysTraced() : 0;
    const uint64_t hybridRaysBefore = hybridTracer_ ? hybridTracer_->raysTraced() : 0;

    // All that virtual lights bring, and what they bring too little.
    const VplTarget target{noisy.irradiance, sums_};
    stream.clear(target.irradiance, {});
    stream.clear(target.sums, {});
    light_.addToTexels(context, vpls, visibility, gbuffer, target);
    if (compensation_) compensation_->record(context, vpls, light_, visibility, gbuffer, target);
    const glm::uvec2 blocks = noisy.blocks(gbufferExtent(context.frame, gbuffer.samples));
    stream.dispatch(finish_,
                    {{"position", gbuffer.position, sampler_},
                     {"irradiance", noisy.irradiance},
                     {"sums", sums_, sampler_},
                     {"moments", noisy.moments}},
                    FinishPush{blocks, params_.block}, linearGroups(uint64_t(blocks.x) * blocks.y));
    if (voxelTracer_) {
        context.extraRays += voxelTracer_->raysTraced() - voxelRaysBefore;
        context.voxelCounts.push_back(&voxelTracer_->march().counts());
    }
    if (hybridTracer_) {
        context.extraRays += hybridTracer_->raysTraced() - hybridRaysBefore;
        context.voxelCounts.push_back(&hybridTracer_->counts());
    }
    if (const FrameImage& indirect = context.get(indirect_); indirect.isRead)
        resolve_.record(context, gbuffer, noisy.irradiance, indirect.image);
}

}  // namespace voxray
