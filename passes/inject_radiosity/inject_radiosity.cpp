#include "passes/inject_radiosity/inject_radiosity.h"

#include <algorithm>
#include <utility>

#include "passes/common/compute/dispatch.h"
#include "passes/common/compute/random_seed.h"

namespace voxray {
namespace {

constexpr uint64_t kSurfelIrradianceBytes = 4 * sizeof(float), kRadiosityBytes = sizeof(uint32_t),
                   kLitBytes = 3 * sizeof(uint32_t);

struct ChunkPush {
    uint32_t count;
    uint32_t firstNumber;
};

struct SurfelBouncePush {
    uint32_t count;
    uint32_t firstNumber;
    uint32_t rays;
    uint32_t surfelCount;
};

}  // namespace

void InjectRadiosity::declare(PassBuilder& builder) {
    voxels_ = builder.read<SurfaceVoxels>("voxels", "surface voxels to light");
    surfels_ = builder.read<Surfels>("surfels", "points where irradiance is measured");
    links_ = builder.read<SurfelLinks>("links", "which surfels each surfel sees");
    byVoxel_ = builder.read<SurfelsByVoxel>("surfels_by_voxel", "the surfels of each voxel");
    irradiance_ = builder.write<VoxelIrradiance>("irradiance", "light that arrives at the voxels' surfaces");
    surfelIrradiance_ = builder.write<SurfelIrradiance>("surfel_irradiance", "light that arrives at surfels");
}

void InjectRadiosity::plan(PassPlan& plan) {
    plan.get(irradiance_).lightBounces = params_.bounces;
    sources_ = requireLightSources(*plan.frame.scene, kName);
    injection_.plan(plan, kName, params_, {Surfels::kChunk, false, false}, plan.get(voxels_));
    light_.plan(plan, Surfels::kChunk);
    plan.lightRays = plan.get(surfels_).maxCount * plan.frame.scene->lights.size();
    // A ray's is about 1.
    plan.get(surfelIrradiance_).relativeVariance = 1.0f / float(plan.get(links_).raysPerSurfel);
    if (plan.get(surfelIrradiance_).isRead)
        plan.reserve("indirect irradiance of surfels (estimated)", plan.get(surfels_).maxCount * kLitBytes);
    plan.reserveScratch("light of surfels (estimated)",
                        plan.get(surfels_).maxCount * 2 * (kSurfelIrradianceBytes + kRadiosityBytes));
}

void InjectRadiosity::prepare(PassSetup& setup) {
    injection_.prepare(setup);
    light_.prepare(setup);
    reflect_ =
        makeComputeProgram(setup.device, setup.compiler.compile("passes/inject_radiosity/reflect.comp"));
    keep_ = makeComputeProgram(setup.device, setup.compiler.compile("passes/inject_radiosity/keep.comp"));
    bounce_ = makeComputeProgram(setup.device, setup.compiler.compile("passes/inject_radiosity/bounce.comp"));
}

void InjectRadiosity::record(PassContext& context) {
    const PathScene scene{context.get(voxels_), sources_};
    VoxelIrradiance& irradiance = context.get(irradiance_);
    injection_.begin(context, scene, irradiance);

    // Light by light paths of no, one, two ... bounces.
    const std::vector<ChunkLight> light = measure(context);
    for (uint32_t number = 1; number <= params_.bounces; ++number) bounce(context, number, light);

    // Into the voxels.
    const std::vector<Surfels::Chunk>& chunks = context.get(surfels_).chunks;
    for (size_t i = 0; i < chunks.size(); ++i)
        injection_.write(context, chunks[i].surfels, chunks[i].count, light[i].direct, light[i].indirect);
    if (context.get(surfelIrradiance_).isRead) keep(context, light);
    injection_.finish(context, scene.voxels, irradiance);
    radiosity_[0] = {}, radiosity_[1] = {};
    requireLight(context.stream, scene.voxels, irradiance, *context.frame.scene);
    injection_.fillUnknown(context, scene.voxels, irradiance);
}

std::vector<InjectRadiosity::ChunkLight> InjectRadiosity::measure(PassContext& context) {
    const SurfelLinks& links = context.get(links_);
    for (LargeBuffer& radiosity : radiosity_)
        radiosity = LargeBuffer(context.device, "radiosity of surfels", links.surfelCount * kRadiosityBytes);
    const uint32_t seed = randomSeed(context.frame, context.frameIndex);
    std::vector<ChunkLight> light;
    uint32_t first = 0;
    for (const Surfels::Chunk& chunk : context.get(surfels_).chunks) {
        const uint64_t bytes = chunk.count * kSurfelIrradianceBytes;
        ChunkLight& l = light.emplace_back(Buffer(context.device, "direct irradiance of surfels", bytes),
                                           Buffer(context.device, "indirect irradiance of surfels", bytes));
        context.stream.fill(l.indirect, 0);
        light_.measure(context, sources_, chunk.surfels, chunk.count, params_.lightSamples, seed, l.direct);
        context.stream.dispatch(
            reflect_, {{"surfels", chunk.surfels}, {"direct", l.direct}, {"RadiosityAt", radiosity_[0].at()}},
            ChunkPush{chunk.count, first}, linearGroups(chunk.count));
        first += chunk.count;
    }
    return light;
}

void InjectRadiosity::bounce(PassContext& context, uint32_t number, const std::vector<ChunkLight>& light) {
    const SurfelLinks& links = context.get(links_);
    // Later bounces carry less light, and more even light: fewer rays measure it as well.
    const uint32_t rays = (links.raysPerSurfel + number - 1) / number;
    const std::vector<Surfels::Chunk>& chunks = context.get(surfels_).chunks;
    uint32_t first = 0;
    for (size_t i = 0; i < chunks.size(); ++i) {
        context.stream.dispatch(bounce_,
                                {{"surfels", chunks[i].surfels},
                                 {"LinksAt", links.links.at()},
                                 {"SentAt", radiosity_[0].at()},
                                 {"ReflectedAt", radiosity_[1].at()},
                                 {"indirect", light[i].indirect}},
                                SurfelBouncePush{chunks[i].count, first, rays, links.surfelCount},
                                linearGroups(chunks[i].count));
        first += chunks[i].count;
    }
    std::swap(radiosity_[0], radiosity_[1]);
}

void InjectRadiosity::keep(PassContext& context, const std::vector<ChunkLight>& light) {
    const SurfelsByVoxel& byVoxel = context.get(byVoxel_);
    SurfelIrradiance& kept = context.get(surfelIrradiance_);
    kept.lit = {};
    kept.lit = LargeBuffer(context.device, "indirect irradiance of surfels",
                           std::max(byVoxel.slotCount, 1u) * kLitBytes);
    const std::vector<Surfels::Chunk>& chunks = context.get(surfels_).chunks;
    uint32_t first = 0;
    for (size_t i = 0; i < chunks.size(); ++i) {
        context.stream.dispatch(keep_,
                                {{"indirect", light[i].indirect},
                                 {"SlotsAt", byVoxel.slots.at()},
                                 {"PackedAt", byVoxel.packed.at()},
                                 {"LitAt", kept.lit.at()}},
                                ChunkPush{chunks[i].count, first}, linearGroups(chunks[i].count));
        first += chunks[i].count;
    }
}

}  // namespace voxray
