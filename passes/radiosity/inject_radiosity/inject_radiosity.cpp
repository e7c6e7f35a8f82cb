#include <algorithm>
#include <utility>
#include <vector>

#include "graph/registry.h"
#include "passes/common/compute/random_seed.h"
#include "passes/surfels/surfel_direct_light.h"
#include "passes/surfels/surfel_injection.h"
#include "passes/surfels/surfel_links.h"
#include "passes/surfels/surfels.h"
#include "passes/surfels/surfels_by_voxel.h"

namespace voxray {
namespace {

constexpr uint64_t kSurfelIrradianceBytes = 4 * sizeof(float), kRadiosityBytes = sizeof(uint32_t),
                   kLitBytes = 2 * sizeof(uint64_t);

}  // namespace

/// Radiosity along precomputed links between surfels: direct light by shadow rays, then bounces without rays.
/// Source: Goral et al. 1984; Lehtinen et al. 2008; docs/radiosity.md.
class InjectRadiosity final : public Pass {
 public:
    static constexpr const char* kName = "inject_radiosity";
    static constexpr const char* kHelp =
        "Lights voxels from their surfels by shadow rays and by radiosity along links. "
        "Direct light comes by shadow rays; indirect light comes along the links of link_surfels: "
        "a sum over links per bounce, no rays. For light that changes where surfaces don't. Biased by: "
        "voxel size, the distance of surfels; normal maps are ignored. Noisy by: points_per_voxel, rays_per_surfel. "
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
                          "Shadow rays from each point to the emissive surfaces, and to the environment.", 1u, 256u)});
        }
    };

    explicit InjectRadiosity(const Params& params) : params_(params) {}
    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    /// Irradiance of a chunk's surfels, W/m², 4 floats each.
    struct ChunkLight {
        Buffer direct, indirect;
    };
    /// Measures the direct irradiance of all chunks, and initializes radiosity.
    std::vector<ChunkLight> measureDirect(PassContext& context);
    /// Adds bounce `bounce`, from 1 on, to the indirect irradiance of all chunks.
    void gatherRadiosity(PassContext& context, uint32_t bounce, const std::vector<ChunkLight>& light);
    /// Stores the indirect irradiance of all chunks in the order of SurfelsByVoxel.
    void storeSurfelIrradiance(PassContext& context, const std::vector<ChunkLight>& light);

    const Params params_;
    In<SurfaceVoxels> voxels_{*this, "voxels", "surface voxels to light"};
    In<Surfels> surfels_{*this, "surfels", "points where irradiance is measured"};
    In<SurfelLinks> links_{*this, "links", "which surfels each surfel sees"};
    In<SurfelsByVoxel> byVoxel_{*this, "surfels_by_voxel", "the surfels of each voxel"};
    Out<VoxelIrradiance> irradiance_{*this, "irradiance", "light that arrives at the voxels' surfaces"};
    Out<SurfelIrradiance> surfelIrradiance_{*this, "surfel_irradiance", "light that arrives at surfels"};
    std::vector<LightSource> sources_;
    SurfelDirectLight directLight_{*this};
    SurfelInjection injection_{*this};
    Kernel initRadiosity_{*this, "init_radiosity.comp"};
    Kernel gatherRadiosity_{*this, "gather_radiosity.comp"};
    Kernel storeSurfelIrradiance_{*this, "store_surfel_irradiance.comp"};
    LargeBuffer radiosity_[2];  ///< Scratch: of all surfels, packed; previous and next.
};

void InjectRadiosity::plan(PassPlan& plan) {
    plan[irradiance_].lightBounces = params_.bounces;
    sources_ = requireLightSources(*plan.frame.scene, kName);
    injection_.plan(plan, kName, params_, plan[voxels_]);
    directLight_.plan(plan, Surfels::kMaxChunkSurfels);
    plan.lightRays = uint64_t(plan[surfels_].estimatedCount) * plan.frame.scene->lights.size();
    // The relative variance of one ray is about 1
    plan[surfelIrradiance_].relativeVariance = 1.0f / float(plan[links_].raysPerSurfel);
}

void InjectRadiosity::record(PassContext& context) {
    const PathScene scene{context[voxels_], sources_};
    VoxelIrradiance& irradiance = context[irradiance_];
    injection_.begin(context, scene, irradiance);

    const std::vector<ChunkLight> light = measureDirect(context);
    for (uint32_t bounce = 1; bounce <= params_.bounces; ++bounce) gatherRadiosity(context, bounce, light);

    const std::vector<Surfels::Chunk>& chunks = context[surfels_].chunks;
    for (size_t i = 0; i < chunks.size(); ++i) {
        injection_.writeDirect(context, chunks[i].surfels, chunks[i].count, light[i].direct);
        injection_.writeIndirect(context, chunks[i].surfels, chunks[i].count, light[i].indirect);
    }
    if (context[surfelIrradiance_].isRead) storeSurfelIrradiance(context, light);
    injection_.finish(context, scene.voxels, irradiance);
    radiosity_[0] = {}, radiosity_[1] = {};
    requireLight(context.stream, scene.voxels, irradiance, *context.frame.scene);
    injection_.fillUnknown(context, scene.voxels, irradiance);
}

std::vector<InjectRadiosity::ChunkLight> InjectRadiosity::measureDirect(PassContext& context) {
    const SurfelLinks& links = context[links_];
    for (LargeBuffer& radiosity : radiosity_)
        radiosity = LargeBuffer(context.device, "radiosity of surfels", links.surfelCount * kRadiosityBytes);
    const uint32_t seed = randomSeed(context.frame, context.frameIndex);
    std::vector<ChunkLight> light;
    for (const Surfels::Chunk& chunk : context[surfels_].chunks) {
        const uint64_t bytes = chunk.count * kSurfelIrradianceBytes;
        ChunkLight& chunkLight = light.emplace_back(Buffer(context.device, "direct irradiance of surfels", bytes),
                                                    Buffer(context.device, "indirect irradiance of surfels", bytes));
        context.stream.fill(chunkLight.indirect, 0);
        directLight_.measure(context, sources_, chunk.surfels, chunk.count, params_.lightSamples, seed,
                             chunkLight.direct);
        context.dispatch(initRadiosity_, chunk.count,
                         {{"surfels", chunk.surfels},
                          {"direct", chunkLight.direct},
                          {"RadiosityRef", radiosity_[0].ref()},
                          {"count", chunk.count},
                          {"firstSurfel", chunk.firstIndex}});
    }
    return light;
}

void InjectRadiosity::gatherRadiosity(PassContext& context, uint32_t bounce, const std::vector<ChunkLight>& light) {
    const SurfelLinks& links = context[links_];
    // Later bounces carry less and smoother light: fewer rays suffice
    const uint32_t rays = (links.raysPerSurfel + bounce - 1) / bounce;
    const std::vector<Surfels::Chunk>& chunks = context[surfels_].chunks;
    for (size_t i = 0; i < chunks.size(); ++i)
        context.dispatch(gatherRadiosity_, chunks[i].count,
                         {{"surfels", chunks[i].surfels},
                          {"LinksRef", links.links.ref()},
                          {"PreviousRadiosityRef", radiosity_[0].ref()},
                          {"NextRadiosityRef", radiosity_[1].ref()},
                          {"indirect", light[i].indirect},
                          {"count", chunks[i].count},
                          {"firstSurfel", chunks[i].firstIndex},
                          {"rays", rays},
                          {"surfelCount", links.surfelCount}});
    std::swap(radiosity_[0], radiosity_[1]);
}

void InjectRadiosity::storeSurfelIrradiance(PassContext& context, const std::vector<ChunkLight>& light) {
    const SurfelsByVoxel& byVoxel = context[byVoxel_];
    SurfelIrradiance& surfelIrradiance = context[surfelIrradiance_];
    ensureSize(surfelIrradiance.lit, context.device, "indirect irradiance of surfels",
               std::max(byVoxel.sortedCount, 1u) * kLitBytes);
    const std::vector<Surfels::Chunk>& chunks = context[surfels_].chunks;
    for (size_t i = 0; i < chunks.size(); ++i)
        context.dispatch(storeSurfelIrradiance_, chunks[i].count,
                         {{"indirect", light[i].indirect},
                          {"SortedIndicesRef", byVoxel.sortedIndices.ref()},
                          {"PackedRef", byVoxel.packed.ref()},
                          {"LitRef", surfelIrradiance.lit.ref()},
                          {"count", chunks[i].count},
                          {"firstSurfel", chunks[i].firstIndex}});
}

VOXRAY_REGISTER_PASS(InjectRadiosity);

}  // namespace voxray
