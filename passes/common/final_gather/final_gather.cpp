#include "passes/common/final_gather/final_gather.h"

#include "base/error.h"
#include "passes/common/compute/bindings.h"
#include "passes/common/compute/dispatch.h"
#include "passes/common/compute/random_seed.h"
#include "passes/common/view/frame_image.h"

namespace voxray {
namespace {

struct ShadePush {
    gpu::GatherLayout layout;
    uint32_t firstBlock;
    uint32_t rays;
    float nearField;
};

/// As in hit.glsl.
struct Counts {
    uint32_t surfels, unlit;
};

struct ReflectPush {
    uint32_t count;
    uint32_t seed;
};

struct GoOnPush {
    uint32_t rays;
    float nearField;
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

void FinalGather::declare(PassBuilder& builder) {
    gbuffer_ = builder.read<GBuffer>("gbuffer", "what the camera sees");
    hits_ = builder.read<GatherHits>("gather_hits", "where the gather rays hit");
    noisy_ = builder.write<NoisyIrradiance>("noisy_irradiance", "irradiance from few rays a texel");
    indirect_ = builder.write<FrameImage>("indirect", "radiance reflected of indirect light, unfiltered");
}

void FinalGather::plan(PassPlan& plan, const Settings& settings) {
    settings_ = settings;
    const GatherHits& hits = plan.get(hits_);
    const uint32_t texelsPerBlock = hits.layout.blockSize * hits.layout.blockSize;
    NoisyIrradiance& noisy = plan.get(noisy_);
    noisy.lightBounces = plan.get(indirect_).lightBounces = oneMore(settings.storedBounces);
    noisy.spacing = hits.layout.raysPerBlock < texelsPerBlock ? hits.layout.blockSize : 1;
    if (plan.get(indirect_).isRead && noisy.spacing > 1)
        throw Error(
            "{3}: blocks of {0}x{0} texels have {1} rays, which leaves texels without any; let "
            "filter_irradiance follow, or raise 'rays_per_block' of trace_gather_rays to {2}",
            hits.layout.blockSize, hits.layout.raysPerBlock, texelsPerBlock, settings.pass);
    plan.image(noisy.irradiance, "noisy irradiance",
               NoisyIrradiance::desc(plan.frame, plan.get(gbuffer_).samples));
    if (noisy.isRead) {
        noisy.blockSize = hits.layout.blockSize;
        plan.buffer(noisy.moments, "moments of rays", noisy.momentsBytes(hits.layout.texels));
    }
    if (FrameImage& indirect = plan.get(indirect_); indirect.isRead)
        plan.image(indirect.image, "indirect", frameImageDesc(plan.frame));
    plan.buffer(light_, "light of gather rays", batchRays(hits) * kLightBytes);
    plan.buffer(surfels_[0], "surfels at hits", batchRays(hits) * sizeof(gpu::Surfel));
    plan.buffer(goesOn_, "surfels whose rays go on", batchRays(hits) * 2 * sizeof(uint32_t));
    plan.buffer(counts_, "counts of hits", sizeof(Counts));
    if (measuresDirect()) {
        sources_ = lightSources(*plan.frame.scene);
        hitLight_.plan(plan, uint32_t(batchRays(hits)));
        plan.buffer(surfels_[1], "surfels one step before", batchRays(hits) * sizeof(gpu::Surfel));
        plan.buffer(direct_, "direct light at hits", batchRays(hits) * kLightBytes);
        plan.buffer(rays_, "next rays", batchRays(hits) * sizeof(Ray));
        plan.buffer(nextHits_, "next hits", batchRays(hits) * sizeof(Hit));
    }
}

void FinalGather::prepare(PassSetup& setup) {
    const auto program = [&](const std::string& file) {
        return makeComputeProgram(setup.device, setup.compiler.compile(file));
    };
    const auto reader = [&](const std::string& file) {
        const Defines defines = settings_.shadowRays ? Defines{{"SHADOW_RAYS", "1"}} : Defines{};
        return makeComputeProgram(setup.device,
                                  setup.compiler.compile("passes/" + settings_.pass + "/" + file, defines),
                                  settings_.constants);
    };
    shade_ = reader("shade.comp");
    collect_ = program("passes/common/final_gather/collect.comp");
    if (setup.get(noisy_).isRead) moments_ = program("passes/common/final_gather/moments.comp");
    if (setup.get(indirect_).isRead) resolve_ = IrradianceResolve(setup);
    sampler_ = texelSampler(setup.device);
    if (!measuresDirect()) return;
    reflect_ = program("passes/common/final_gather/reflect.comp");
    goOn_ = reader("go_on.comp");
    hitLight_.prepare(setup);
}

void FinalGather::record(PassContext& context, const std::vector<Binding>& stored) {
    traced_ = unlit_ = 0;
    for (uint32_t b = 0; b < context.get(hits_).batches.size(); ++b) gather(context, stored, b);
    context.report(settings_.unlit, traced_ > 0 ? 100 * unlit_ / traced_ : 0);
    if (const FrameImage& indirect = context.get(indirect_); indirect.isRead)
        resolve_.record(context, context.get(gbuffer_), context.get(noisy_).irradiance, indirect.image);
}

void FinalGather::gather(PassContext& context, const std::vector<Binding>& stored, uint32_t batch) {
    const GBuffer& gbuffer = context.get(gbuffer_);
    const GatherHits& hits = context.get(hits_);
    const uint32_t firstBlock = batch * hits.blocksPerBatch, blocks = hits.batchBlocks(batch);
    const uint32_t rays = blocks * hits.layout.raysPerBlock;
    const uint32_t texelsPerBlock = hits.layout.blockSize * hits.layout.blockSize;
    CommandStream& stream = context.stream;

    // Shade the hits with the irradiance that is stored there, and measure light where none is to be had.
    std::vector<Binding> shading = endBindings(context, stored, hits.batches[batch], surfels_[0]);
    shading.push_back({"position", gbuffer.position, sampler_});
    traced_ += rays;
    stream.fill(counts_, 0);
    stream.dispatch(shade_, shading, ShadePush{hits.layout, firstBlock, rays, settings_.nearFieldCells},
                    linearGroups(rays));
    follow(context, stored);

    // Add up what the rays of each texel and of each block bring.
    const NoisyIrradiance& noisy = context.get(noisy_);
    stream.dispatch(collect_, {{"light", light_}, {"gathered", noisy.irradiance}},
                    CollectPush{hits.layout, firstBlock, blocks},
                    linearGroups(uint64_t(blocks) * texelsPerBlock));
    if (noisy.isRead)
        stream.dispatch(moments_, {{"light", light_}, {"moments", noisy.moments}},
                        MomentsPush{firstBlock, blocks, hits.layout.raysPerBlock}, linearGroups(blocks));
}

std::vector<Binding> FinalGather::endBindings(PassContext& context, const std::vector<Binding>& stored,
                                              const Buffer& hits, const Buffer& surfels) const {
    return joined(context.scene.bindings({{"hits", hits},
                                          {"light", light_},
                                          {"surfels", surfels},
                                          {"goesOn", goesOn_},
                                          {"counts", counts_}}),
                  stored);
}

uint32_t FinalGather::takeCounts(CommandStream& stream) {
    const Counts counts = stream.readAs<Counts>(counts_, 1)[0];
    unlit_ += counts.unlit;
    return counts.surfels;
}

void FinalGather::follow(PassContext& context, const std::vector<Binding>& stored) {
    CommandStream& stream = context.stream;
    for (uint32_t step = 0; step <= settings_.maxSteps; ++step) {
        const uint32_t surfels = takeCounts(stream);
        if (surfels == 0) return;

        // Direct light at the surfels, and rays on.
        const Buffer &from = surfels_[step % 2], &to = surfels_[(step + 1) % 2];
        const uint32_t seed = randomSeed(context.frame, context.frameIndex) + 0x51u + step * 0x9e3779b9u;
        hitLight_.measure(context, sources_, from, surfels, settings_.lightSamples, seed, direct_);
        stream.dispatch(reflect_,
                        context.scene.bindings({{"surfels", from},
                                                {"direct", direct_},
                                                {"light", light_},
                                                {"goesOn", goesOn_},
                                                {"rays", rays_}}),
                        ReflectPush{surfels, seed + 0xa3u}, linearGroups(surfels));
        if (settings_.nearFieldCells == 0 || step == settings_.maxSteps) return;

        // Where those end.
        context.tracer.closestHit(stream, rays_, nextHits_, surfels);
        traced_ += surfels;
        stream.fill(counts_, 0);
        std::vector<Binding> ends = endBindings(context, stored, nextHits_, to);
        ends.insert(ends.end(), {{"from", from}, {"rays", rays_}});
        const bool isLast = step + 1 == settings_.maxSteps;
        stream.dispatch(goOn_, ends, GoOnPush{surfels, isLast ? 0.0f : settings_.nearFieldCells},
                        linearGroups(surfels));
    }
}

}  // namespace voxray
