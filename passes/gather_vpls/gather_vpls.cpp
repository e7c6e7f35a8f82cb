#include "passes/gather_vpls/gather_vpls.h"

#include <algorithm>
#include <glm/gtc/constants.hpp>

#include "base/error.h"
#include "passes/common/compute/dispatch.h"
#include "passes/common/lights/light_sources.h"
#include "passes/common/view/frame_image.h"

namespace voxray {
namespace {

constexpr uint32_t kBatchRays = 1u << 20;  // Bounds the memory of rays and what they carry to 52 MiB.

/// One batch: so many texels of a subset's image, and so many of the subset's virtual lights.
struct Batch {
    glm::uvec2 texels;  ///< Of the G-buffer.
    glm::uvec2 extent;  ///< Of the subset's image.
    glm::uvec2 subset;  ///< Place within a block.
    uint32_t block;
    uint32_t firstTexel, texelCount;
    uint32_t firstVpl, vplCount;  ///< Of the list of virtual lights.
};

struct AimPush {
    Batch batch;
    float minDistanceSquared;
    float minOffset;
};

struct AddPush {
    Batch batch;
};

VoxelWalk walkOf(VplVisibility visibility) {
    switch (visibility) {
        case VplVisibility::SvoRestart:
            return VoxelWalk::OctreeRestart;
        case VplVisibility::Bricks:
            return VoxelWalk::Bricks;
        case VplVisibility::Bits:
            return VoxelWalk::Bits;
        default:
            return VoxelWalk::Octree;
    }
}

/// Squared radius of the disc whose area is that of the surface for each path of light.
float squaredRadius(const Geometry& geometry, uint32_t paths) {
    return float(surfaceArea(geometry) / (glm::pi<double>() * paths));
}

}  // namespace

void GatherVpls::declare(PassBuilder& builder) {
    gbuffer_ = builder.read<GBuffer>("gbuffer", "what the camera sees");
    vpls_ = builder.read<Vpls>("vpls", "virtual point lights");
    if (params_.visibility != VplVisibility::Exact && params_.visibility != VplVisibility::None) {
        voxels_ = builder.read<SurfaceVoxels>("voxels", "what shadow rays meet");
        voxelTracer_.emplace(walkOf(params_.visibility), params_.restartEpsilon);
    }
    noisy_ = builder.write<NoisyIrradiance>("noisy_irradiance", "irradiance from a subset of lights a texel");
    indirect_ = builder.write<FrameImage>("indirect", "radiance reflected of indirect light, unfiltered");
}

void GatherVpls::plan(PassPlan& plan) {
    if (params_.restartEpsilon > 0 && params_.visibility != VplVisibility::SvoRestart)
        throw Error("{}: 'restart_epsilon' is a step of 'visibility: svo_restart' alone; leave it out",
                    kName);
    // Things move without changing their area
    minDistanceSquared_ =
        params_.bound * params_.bound * squaredRadius(plan.frame.scene->geometry, plan.get(vpls_).paths);
    const uint32_t samples = plan.get(gbuffer_).samples;
    const glm::uvec2 extent = subsetExtent(gbufferExtent(plan.frame, samples));
    const uint64_t texels = std::min(extent.x * extent.y, kBatchRays);
    const uint64_t perTexel =
        uint64_t(plan.get(vpls_).paths) * plan.get(vpls_).bounces / (params_.block * params_.block) + 1;
    const uint64_t rays = std::min(texels * perTexel, uint64_t(kBatchRays));
    NoisyIrradiance& noisy = plan.get(noisy_);
    plan.image(noisy.irradiance, "noisy irradiance", NoisyIrradiance::desc(plan.frame, samples));
    if (FrameImage& indirect = plan.get(indirect_); indirect.isRead)
        plan.image(indirect.image, "indirect", frameImageDesc(plan.frame));
    plan.buffer(carried_, "light of virtual point lights", rays * 4 * sizeof(float));
    plan.buffer(rays_, "shadow rays", rays * sizeof(Ray));
    plan.buffer(occluded_, "shadow ray results", rays * sizeof(uint32_t));
    if (voxelTracer_) voxelTracer_->plan(plan, plan.frame.scene->geometry, plan.get(voxels_));
}

void GatherVpls::prepare(PassSetup& setup) {
    aim_ = makeComputeProgram(setup.device, setup.compiler.compile("passes/gather_vpls/aim.comp"));
    add_ = makeComputeProgram(setup.device, setup.compiler.compile("passes/gather_vpls/add.comp"));
    sampler_ = texelSampler(setup.device);
    if (setup.get(indirect_).isRead) resolve_ = IrradianceResolve(setup);
    if (voxelTracer_) voxelTracer_->prepare(setup.device, setup.compiler);
}

void GatherVpls::record(PassContext& context) {
    CommandStream& stream = context.stream;
    const GBuffer& gbuffer = context.get(gbuffer_);
    const Vpls& vpls = context.get(vpls_);
    const NoisyIrradiance& noisy = context.get(noisy_);
    RayTracer* tracer = params_.visibility == VplVisibility::None ? nullptr : &context.tracer;
    float minOffset = 0;
    if (voxelTracer_) {
        const SurfaceVoxels& voxels = context.get(voxels_);
        minOffset = VOXELS_OFF_SURFACE * voxels.grid.voxelSize;
        voxelTracer_->begin(stream, voxels);
        tracer = &*voxelTracer_;
    }
    const uint64_t raysBefore = tracer ? tracer->raysTraced() : 0;
    stream.clear(noisy.irradiance, {});
    if (!tracer) stream.fill(occluded_, 0);

    // Texels and virtual lights of one subset after the other: their rays lie next to each other.
    Batch batch{};
    batch.texels = gbufferExtent(context.frame, gbuffer.samples);
    batch.extent = subsetExtent(batch.texels);
    batch.block = params_.block;
    const uint32_t texels = batch.extent.x * batch.extent.y, subsets = params_.block * params_.block;
    const auto light = [&] {
        if (const uint32_t rays = batch.texelCount * batch.vplCount; rays > 0) {
            stream.dispatch(aim_,
                            {{"position", gbuffer.position, sampler_},
                             {"normal", gbuffer.normal, sampler_},
                             {"geometricNormal", gbuffer.geometricNormal, sampler_},
                             {"vpls", vpls.points},
                             {"list", vpls.list},
                             {"rays", rays_},
                             {"carried", carried_}},
                            AimPush{batch, minDistanceSquared_, minOffset}, linearGroups(rays));
            if (tracer) tracer->occluded(stream, rays_, occluded_, rays, Coherence::Coherent);
        }
        stream.dispatch(add_,
                        {{"position", gbuffer.position, sampler_},
                         {"carried", carried_},
                         {"occluded", occluded_},
                         {"irradiance", noisy.irradiance}},
                        AddPush{batch}, linearGroups(batch.texelCount));
    };
    for (uint32_t subset = 0; subset < subsets; ++subset) {
        batch.subset = {subset % params_.block, subset / params_.block};
        // Runs of the list that differ in length by one at most
        const auto first = uint32_t(uint64_t(vpls.count) * subset / subsets);
        const auto end = uint32_t(uint64_t(vpls.count) * (subset + 1) / subsets);
        for (batch.firstTexel = 0; batch.firstTexel < texels; batch.firstTexel += batch.texelCount) {
            batch.texelCount = std::min(texels - batch.firstTexel, kBatchRays);
            const uint32_t maxVpls =
                std::max(1u, uint32_t(carried_.bytes() / (4 * sizeof(float))) / batch.texelCount);
            batch.firstVpl = first;
            do {
                batch.vplCount = std::min(end - batch.firstVpl, maxVpls);
                light();
                batch.firstVpl += batch.vplCount;
            } while (batch.firstVpl < end);
        }
    }
    if (voxelTracer_) {
        context.extraRays += tracer->raysTraced() - raysBefore;
        context.voxelCounts.push_back(&voxelTracer_->march().counts());
    }
    if (const FrameImage& indirect = context.get(indirect_); indirect.isRead)
        resolve_.record(context, gbuffer, noisy.irradiance, indirect.image);
}

}  // namespace voxray
