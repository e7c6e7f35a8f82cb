#include <algorithm>
#include <utility>
#include <vector>

#include "graph/registry.h"
#include "passes/common/compute/random_seed.h"
#include "passes/surfels/surfel_injection.h"
#include "passes/surfels/surfel_light.h"
#include "passes/surfels/surfel_links.h"
#include "passes/surfels/surfels.h"
#include "passes/surfels/surfels_by_voxel.h"

namespace voxray {
namespace {

constexpr uint64_t kSurfelIrradianceBytes = 4 * sizeof(float), kRadiosityBytes = sizeof(uint32_t),
                   kLitBytes = 3 * sizeof(uint32_t);

}  // namespace

/// Light between surfels along links that were found beforehand: shadow rays to the lights, and no ray for
/// any bounce. Source: Goral et al. 1984; Lehtinen et al. 2008; docs/radiosity.md.
class InjectRadiosity final : public Pass {
 public:
    static constexpr const char* kName = "inject_radiosity";
    static constexpr const char* kHelp =
        "Lights surfels by shadow rays and by radiosity along their links. Direct light of the voxels' "
        "surfels comes by shadow rays. Indirect light comes along the links of link_surfels: a sum over "
        "links for each bounce, no rays. For light that changes where surfaces don't. Biased by: voxel size, "
        "surfels' distance; textures' normals are left out. Noisy by: points_per_voxel, rays_per_surfel. "
        "Leaves unlit: nothing. Source: Goral et al. 1984; Lehtinen et al. 2008.";
    struct Params : WriteParams {
        uint32_t bounces = 8;
        uint32_t lightSamples = 4;
        static constexpr auto schema() {
            return std::tuple_cat(
                WriteParams::schema(),
                std::tuple{
                    field("bounces", &Params::bounces, "Bounces of light.", 0u, 64u),
                    field("light_samples", &Params::lightSamples,
                          "Shadow rays from each point to the emissive surfaces, and to the environment.", 1u,
                          256u)});
        }
    };

    explicit InjectRadiosity(const Params& params) : params_(params) {}
    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    /// Of a chunk of surfels, W/m², 4 floats each.
    struct ChunkLight {
        Buffer direct, indirect;
    };
    /// Direct irradiance of all chunks, and what it leaves of radiosity.
    std::vector<ChunkLight> measure(PassContext& context);
    /// Bounce 1, 2 ...: adds to the indirect irradiance of all chunks.
    void bounce(PassContext& context, uint32_t number, const std::vector<ChunkLight>& light);

    /// Leaves the indirect irradiance of all chunks in the surfels' slots.
    void keep(PassContext& context, const std::vector<ChunkLight>& light);

    const Params params_;
    In<SurfaceVoxels> voxels_{*this, "voxels", "surface voxels to light"};
    In<Surfels> surfels_{*this, "surfels", "points where irradiance is measured"};
    In<SurfelLinks> links_{*this, "links", "which surfels each surfel sees"};
    In<SurfelsByVoxel> byVoxel_{*this, "surfels_by_voxel", "the surfels of each voxel"};
    Out<VoxelIrradiance> irradiance_{*this, "irradiance", "light that arrives at the voxels' surfaces"};
    Out<SurfelIrradiance> surfelIrradiance_{*this, "surfel_irradiance", "light that arrives at surfels"};
    std::vector<LightSource> sources_;
    SurfelLight light_{*this};
    SurfelInjection injection_{*this};
    Kernel reflect_{*this, "reflect.comp"};
    Kernel bounce_{*this, "bounce.comp"};
    Kernel keep_{*this, "keep.comp"};
    LargeBuffer radiosity_[2];  ///< Scratch: of all surfels, packed; before and after a bounce.
};

void InjectRadiosity::plan(PassPlan& plan) {
    plan[irradiance_].lightBounces = params_.bounces;
    sources_ = requireLightSources(*plan.frame.scene, kName);
    injection_.plan(plan, kName, params_, plan[voxels_]);
    light_.plan(plan, Surfels::kChunk);
    plan.lightRays = uint64_t(plan[surfels_].estimatedCount) * plan.frame.scene->lights.size();
    // A ray's is about 1.
    plan[surfelIrradiance_].relativeVariance = 1.0f / float(plan[links_].raysPerSurfel);
}

void InjectRadiosity::record(PassContext& context) {
    const PathScene scene{context[voxels_], sources_};
    VoxelIrradiance& irradiance = context[irradiance_];
    injection_.begin(context, scene, irradiance);

    // Light by light paths of no, one, two ... bounces.
    const std::vector<ChunkLight> light = measure(context);
    for (uint32_t number = 1; number <= params_.bounces; ++number) bounce(context, number, light);

    // Into the voxels.
    const std::vector<Surfels::Chunk>& chunks = context[surfels_].chunks;
    for (size_t i = 0; i < chunks.size(); ++i) {
        injection_.writeDirect(context, chunks[i].surfels, chunks[i].count, light[i].direct);
        injection_.writeIndirect(context, chunks[i].surfels, chunks[i].count, light[i].indirect);
    }
    if (context[surfelIrradiance_].isRead) keep(context, light);
    injection_.finish(context, scene.voxels, irradiance);
    radiosity_[0] = {}, radiosity_[1] = {};
    requireLight(context.stream, scene.voxels, irradiance, *context.frame.scene);
    injection_.fillUnknown(context, scene.voxels, irradiance);
}

std::vector<InjectRadiosity::ChunkLight> InjectRadiosity::measure(PassContext& context) {
    const SurfelLinks& links = context[links_];
    for (LargeBuffer& radiosity : radiosity_)
        radiosity = LargeBuffer(context.device, "radiosity of surfels", links.surfelCount * kRadiosityBytes);
    const uint32_t seed = randomSeed(context.frame, context.frameIndex);
    std::vector<ChunkLight> light;
    uint32_t first = 0;
    for (const Surfels::Chunk& chunk : context[surfels_].chunks) {
        const uint64_t bytes = chunk.count * kSurfelIrradianceBytes;
        ChunkLight& l = light.emplace_back(Buffer(context.device, "direct irradiance of surfels", bytes),
                                           Buffer(context.device, "indirect irradiance of surfels", bytes));
        context.stream.fill(l.indirect, 0);
        light_.measure(context, sources_, chunk.surfels, chunk.count, params_.lightSamples, seed, l.direct);
        context.dispatch(reflect_, chunk.count,
                         {{"surfels", chunk.surfels},
                          {"direct", l.direct},
                          {"RadiosityAt", radiosity_[0].at()},
                          {"count", chunk.count},
                          {"firstNumber", first}});
        first += chunk.count;
    }
    return light;
}

void InjectRadiosity::bounce(PassContext& context, uint32_t number, const std::vector<ChunkLight>& light) {
    const SurfelLinks& links = context[links_];
    // Later bounces carry less light, and more even light: fewer rays measure it as well.
    const uint32_t rays = (links.raysPerSurfel + number - 1) / number;
    const std::vector<Surfels::Chunk>& chunks = context[surfels_].chunks;
    uint32_t first = 0;
    for (size_t i = 0; i < chunks.size(); ++i) {
        context.dispatch(bounce_, chunks[i].count,
                         {{"surfels", chunks[i].surfels},
                          {"LinksAt", links.links.at()},
                          {"SentAt", radiosity_[0].at()},
                          {"ReflectedAt", radiosity_[1].at()},
                          {"indirect", light[i].indirect},
                          {"count", chunks[i].count},
                          {"firstNumber", first},
                          {"rays", rays},
                          {"surfelCount", links.surfelCount}});
        first += chunks[i].count;
    }
    std::swap(radiosity_[0], radiosity_[1]);
}

void InjectRadiosity::keep(PassContext& context, const std::vector<ChunkLight>& light) {
    const SurfelsByVoxel& byVoxel = context[byVoxel_];
    SurfelIrradiance& kept = context[surfelIrradiance_];
    makeOrKeep(kept.lit, context.device, "indirect irradiance of surfels",
               std::max(byVoxel.slotCount, 1u) * kLitBytes);
    const std::vector<Surfels::Chunk>& chunks = context[surfels_].chunks;
    uint32_t first = 0;
    for (size_t i = 0; i < chunks.size(); ++i) {
        context.dispatch(keep_, chunks[i].count,
                         {{"indirect", light[i].indirect},
                          {"SlotsAt", byVoxel.slots.at()},
                          {"PackedAt", byVoxel.packed.at()},
                          {"LitAt", kept.lit.at()},
                          {"count", chunks[i].count},
                          {"firstNumber", first}});
        first += chunks[i].count;
    }
}

VOXRAY_REGISTER_PASS(InjectRadiosity);

}  // namespace voxray
