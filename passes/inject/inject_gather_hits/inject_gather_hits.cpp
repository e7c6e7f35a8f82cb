#include <vector>

#include "graph/registry.h"
#include "passes/common/compute/random_seed.h"
#include "passes/common/view/gather_hits.h"
#include "passes/common/view/gbuffer.h"
#include "passes/surfels/surfel_injection.h"
#include "passes/surfels/surfels.h"

namespace voxray {

/// Lights only the faces of voxels that the frame's gather rays will read, each by paths from points on
/// it: shadow rays to the lights, a diffuse ray on, and so on. Source: Magalhães 2020, section 6.1 (light
/// only what the view needs).
class InjectGatherHits final : public Pass {
 public:
    static constexpr const char* kName = "inject_gather_hits";
    static constexpr const char* kHelp =
        "Lights the voxel faces that gather rays hit, by paths from surfels. It does so in each frame. The "
        "rays are those of trace_gather_rays, and the paths start at points on the faces (place_surfels). "
        "Biased by: voxel size. Noisy by: points_per_voxel, paths_per_point. Leaves unlit: all that "
        "trace_gather_rays (which must come before) does not hit.";
    struct Params : SurfelParams {
        uint32_t lightSamples = 1;
        /// In each frame, for gather rays, which average over many points: few paths do.
        Params() { pathsPerPoint = 1; }
        static constexpr auto schema() {
            return std::tuple_cat(
                SurfelParams::schema(),
                std::tuple{
                    field("light_samples", &Params::lightSamples,
                          "Shadow rays from each point to the emissive surfaces, and to the environment.", 1u,
                          256u)});
        }
    };

    explicit InjectGatherHits(const Params& params) : params_(params) {}
    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    void markFaces(PassContext& context);
    void lightFaces(PassContext& context, const PathScene& scene);

    const Params params_;
    In<SurfaceVoxels> voxels_{*this, "voxels", "surface voxels to light"};
    In<Surfels> surfels_{*this, "surfels", "points where irradiance is measured"};
    In<GBuffer> gbuffer_{*this, "gbuffer", "where the gather rays start"};
    In<GatherHits> hits_{*this, "gather_hits", "where the gather rays hit"};
    Out<VoxelIrradiance> irradiance_{*this, "irradiance", "light that arrives at the voxels' surfaces"};
    std::vector<LightSource> sources_;
    SurfelInjection injection_{*this};
    Kernel measure_{*this, "measured_faces.comp"};
    Kernel mark_{*this, "mark.comp"};
    Kernel select_{*this, "select.comp"};
    Buffer selected_, count_;  ///< Of a chunk's surfels, those to light.
    Buffer faces_;             ///< A bit for each face that is read, in a word for each voxel.
    Buffer measured_;          ///< The same for each face that has surfels.
};

void InjectGatherHits::plan(PassPlan& plan) {
    plan[irradiance_].lightBounces = params_.bounces;
    sources_ = requireLightSources(*plan.frame.scene, kName);
    injection_.plan(plan, kName, params_, {Surfels::kChunk, true, params_.bounces > 0, params_.lightSamples},
                    plan[voxels_]);
    plan.buffer(count_, "number of surfels to light", sizeof(uint32_t));
    plan.buffer(selected_, "surfels to light", Surfels::kChunk * sizeof(gpu::Surfel));
}

void InjectGatherHits::record(PassContext& context) {
    const PathScene scene{context[voxels_], sources_};
    injection_.begin(context, scene, context[irradiance_]);
    markFaces(context);
    lightFaces(context, scene);
    injection_.finish(context, scene.voxels, context[irradiance_]);
}

void InjectGatherHits::markFaces(PassContext& context) {
    const SurfaceVoxels& voxels = context[voxels_];
    const GatherHits& hits = context[hits_];
    const auto clear = [&](Buffer& buffer, const char* name) {
        makeOrKeep(buffer, context.device, name, uint64_t(voxels.voxelCount) * sizeof(uint32_t));
        context.stream.fill(buffer, 0);
    };
    clear(faces_, "faces to light");
    if (context.changed(voxels_) || context.changed(surfels_)) {
        clear(measured_, "faces with surfels");
        for (const Surfels::Chunk& chunk : context[surfels_].chunks)
            context.dispatch(measure_, chunk.count,
                             {{"surfels", chunk.surfels}, {"measured", measured_}, {"count", chunk.count}});
    }
    for (uint32_t b = 0; b < hits.batches.size(); ++b) {
        const uint32_t rays = hits.batchBlocks(b) * hits.layout.raysPerBlock;
        context.dispatch(mark_, rays,
                         {context.scene,
                          context[gbuffer_],
                          voxels,
                          {"hits", hits.batches[b]},
                          {"asked", faces_},
                          {"measured", measured_},
                          {"layout", hits.layout},
                          {"firstBlock", b * hits.blocksPerBatch},
                          {"rays", rays}});
    }
}

void InjectGatherHits::lightFaces(PassContext& context, const PathScene& scene) {
    const uint32_t seed = randomSeed(context.frame, context.frameIndex);
    CommandStream& stream = context.stream;
    for (const Surfels::Chunk& chunk : context[surfels_].chunks) {
        stream.fill(count_, 0);
        context.dispatch(select_, chunk.count,
                         {{"surfels", chunk.surfels},
                          {"asked", faces_},
                          {"selected", selected_},
                          {"selectedCount", count_},
                          {"count", chunk.count}});
        const uint32_t count = stream.readAs<uint32_t>(count_, 1)[0];
        if (count > 0) injection_.light(context, scene, selected_, count, params_, seed);
    }
}

VOXRAY_REGISTER_PASS(InjectGatherHits);

}  // namespace voxray
