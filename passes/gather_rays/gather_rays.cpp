#include "passes/gather_rays/gather_rays.h"

#include "base/error.h"
#include "passes/common/compute/dispatch.h"
#include "passes/common/compute/random_seed.h"
#include "passes/common/view/frame_image.h"

namespace voxray {
namespace {

struct ShadePush {
    gpu::VoxelGrid grid;
    gpu::GatherLayout layout;
    uint32_t firstBlock;
    uint32_t rays;
};

struct CollectPush {
    gpu::GatherLayout layout;
    uint32_t firstBlock;
    uint32_t batchBlocks;
};

struct MomentsPush {
    uint32_t firstBlock;
    uint32_t batchBlocks;
    uint32_t raysPerBlock;
};

uint64_t batchRays(const GatherHits& hits) {
    return uint64_t(hits.blocksPerBatch) * hits.layout.raysPerBlock;
}

constexpr uint64_t kLightBytes = 4 * sizeof(float);  // Of a ray, or of a surfel.

}  // namespace

void GatherRays::declare(PassBuilder& builder) {
    gbuffer_ = builder.read<GBuffer>("gbuffer", "what the camera sees");
    voxels_ = builder.read<SurfaceVoxels>("voxels", "surface voxels");
    irradiance_ = builder.read<VoxelIrradiance>("irradiance", "light that arrives at the voxels' surfaces");
    hits_ = builder.read<GatherHits>("gather_hits", "where the gather rays hit");
    noisy_ = builder.write<NoisyIrradiance>("noisy_irradiance", "irradiance from few rays a texel");
    indirect_ = builder.write<FrameImage>("indirect", "radiance reflected of indirect light, unfiltered");
}

void GatherRays::plan(PassPlan& plan) {
    const GatherHits& hits = plan.get(hits_);
    const uint32_t texelsPerBlock = hits.layout.blockSize * hits.layout.blockSize;
    NoisyIrradiance& noisy = plan.get(noisy_);
    noisy.spacing = hits.layout.raysPerBlock < texelsPerBlock ? hits.layout.blockSize : 1;
    if (plan.get(indirect_).isRead && noisy.spacing > 1)
        throw Error(
            "gather_rays: blocks of {0}x{0} texels have {1} rays, which leaves texels without any; let "
            "filter_irradiance follow, or raise 'rays_per_block' of trace_gather_rays to {2}",
            hits.layout.blockSize, hits.layout.raysPerBlock, texelsPerBlock);
    plan.image(noisy.irradiance, "noisy irradiance",
               NoisyIrradiance::desc(plan.frame, plan.get(gbuffer_).samples));
    if (noisy.isRead) {
        noisy.blockSize = hits.layout.blockSize;
        plan.buffer(noisy.moments, "moments of rays", noisy.momentsBytes(hits.layout.texels));
    }
    if (FrameImage& indirect = plan.get(indirect_); indirect.isRead)
        plan.image(indirect.image, "indirect", frameImageDesc(plan.frame));
    plan.buffer(light_, "light of gather rays", batchRays(hits) * kLightBytes);
    if (shadowRays()) {
        sources_ = lightSources(*plan.frame.scene);
        hitLight_.plan(plan, uint32_t(batchRays(hits)));
        plan.buffer(surfels_, "gather ray hits' surfels", batchRays(hits) * sizeof(gpu::Surfel));
        plan.buffer(direct_, "gather ray hits' direct light", batchRays(hits) * kLightBytes);
    }
    plan.reserve("face irradiance (estimated)", FaceIrradiance::bytes(plan.get(voxels_).voxelCount));
}

void GatherRays::prepare(PassSetup& setup) {
    const auto program = [&](const char* file, const Defines& defines = {}) {
        return makeComputeProgram(setup.device, setup.compiler.compile(file, defines));
    };
    const Defines direct = shadowRays() ? Defines{{"SHADOW_RAYS", "1"}} : Defines{};
    shade_ = program("passes/gather_rays/shade.comp", direct);
    collect_ = program("passes/gather_rays/collect.comp", direct);
    if (setup.get(noisy_).isRead) moments_ = program("passes/gather_rays/moments.comp", direct);
    if (setup.get(indirect_).isRead) resolve_ = IrradianceResolve(setup);
    faces_ = FaceIrradiance(setup.device, setup.compiler);
    facesVersion_.reset();
    sampler_ = texelSampler(setup.device);
    if (shadowRays()) hitLight_.prepare(setup);
}

void GatherRays::record(PassContext& context) {
    const SurfaceVoxels& voxels = context.get(voxels_);
    const VoxelIrradiance& light = context.get(irradiance_);
    if (const std::pair version{voxels.version, light.version}; facesVersion_ != version) {
        faces_.update(context.stream, voxels, light.area, light.indirect,
                      shadowRays() ? nullptr : &light.direct);
        facesVersion_ = version;
    }
    for (uint32_t b = 0; b < context.get(hits_).batches.size(); ++b) gather(context, b);
    if (const FrameImage& indirect = context.get(indirect_); indirect.isRead)
        resolve_.record(context, context.get(gbuffer_), context.get(noisy_).irradiance, indirect.image);
}

void GatherRays::gather(PassContext& context, uint32_t batch) {
    const GBuffer& gbuffer = context.get(gbuffer_);
    const SurfaceVoxels& voxels = context.get(voxels_);
    const GatherHits& hits = context.get(hits_);
    const uint32_t firstBlock = batch * hits.blocksPerBatch, blocks = hits.batchBlocks(batch);
    const uint32_t rays = blocks * hits.layout.raysPerBlock;
    const uint32_t texelsPerBlock = hits.layout.blockSize * hits.layout.blockSize;
    CommandStream& stream = context.stream;

    // Shade the hits with the voxels' irradiance, and with direct light by shadow rays.
    std::vector<Binding> shading = context.scene.bindings({{"voxelOccupancy", voxels.occupancy},
                                                           {"voxelRank", voxels.rank},
                                                           {"faceIrradiance", faces_.buffer()},
                                                           {"hits", hits.batches[batch]},
                                                           {"position", gbuffer.position, sampler_},
                                                           {"light", light_}});
    if (shadowRays()) shading.push_back({"surfels", surfels_});
    stream.dispatch(shade_, shading, ShadePush{voxels.grid, hits.layout, firstBlock, rays},
                    linearGroups(rays));
    if (shadowRays())
        hitLight_.measure(context, sources_, surfels_, rays, params_.lightSamples,
                          randomSeed(context.frame, context.frameIndex) + 0x51u, direct_);

    // Add up what the rays of each texel and of each block bring.
    const auto add = [&](const Program& program, Binding target, PushConstants push, uint64_t threads) {
        std::vector<Binding> bindings{{"light", light_}, target};
        if (shadowRays()) bindings.insert(bindings.end(), {{"surfels", surfels_}, {"direct", direct_}});
        stream.dispatch(program, bindings, push, linearGroups(threads));
    };
    const NoisyIrradiance& noisy = context.get(noisy_);
    add(collect_, {"gathered", noisy.irradiance}, CollectPush{hits.layout, firstBlock, blocks},
        uint64_t(blocks) * texelsPerBlock);
    if (noisy.isRead)
        add(moments_, {"moments", noisy.moments}, MomentsPush{firstBlock, blocks, hits.layout.raysPerBlock},
            blocks);
}

}  // namespace voxray
