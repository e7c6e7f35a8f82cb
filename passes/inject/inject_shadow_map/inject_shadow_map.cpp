#include <vector>

#include "graph/registry.h"
#include "passes/common/compute/random_seed.h"
#include "passes/common/lights/pane_tint.h"
#include "passes/common/lights/shadow_map.h"
#include "passes/surfels/surfel_injection.h"
#include "passes/surfels/surfels.h"

namespace voxray {

/// Direct light of the voxels' surfaces by shadow maps: a depth view of the scene from every light is
/// rasterised, and points on the surfaces are tested against it, with percentage-closer filtering over 2x2
/// texels. Bounces by paths, as inject_voxel_rays. Source: Arnebäck 2017 tests voxels against a shadow map
/// as they are voxelized; filtering: Reeves et al. 1987.
class InjectShadowMap final : public Pass {
 public:
    static constexpr const char* kName = "inject_shadow_map";
    static constexpr const char* kHelp =
        "Lights voxels by testing their surfels against each light's shadow map. The surfels are points on "
        "the voxels' surfaces (place_surfels). Light bounces by paths with shadow rays. Point lights take a "
        "cube of six maps, spots one (wider than 90° across: the cube), directional lights one over the "
        "scene's bounding sphere. No emissive surfaces and no environment: they have no single viewpoint. "
        "Biased by: voxel size; shadow_resolution (shadow edges and gaps below a texel). Noisy by: "
        "points_per_voxel, paths_per_point. Leaves unlit: nothing; what lies nearer to a light than 0.0001 "
        "of the scene's extent casts no shadow.";
    struct Params : SurfelParams {
        uint32_t shadowResolution = 1024;
        static constexpr auto schema() {
            return std::tuple_cat(std::tuple{field("shadow_resolution", &Params::shadowResolution,
                                                   "Texels along an edge of each shadow map.", 2u, 8192u)},
                                  SurfelParams::schema());
        }
    };

    explicit InjectShadowMap(const Params& params) : params_(params) {}
    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    static constexpr uint32_t kCubeSides = 6;

    const Params params_;
    In<SurfaceVoxels> voxels_{*this, "voxels", "surface voxels to light"};
    In<Surfels> surfels_{*this, "surfels", "points where irradiance is measured"};
    Out<VoxelIrradiance> irradiance_{*this, "irradiance", "light that arrives at the voxels' surfaces"};
    std::vector<LightSource> sources_;
    Kernel lightSurfels_{*this, "light_surfels.comp"};
    ShadowMap shadowMap_{*this};
    SurfelInjection injection_{*this};
};

void InjectShadowMap::plan(PassPlan& plan) {
    requireClearPanes(*plan.frame.scene, kName);
    plan[irradiance_].lightBounces = params_.bounces;
    sources_ = requireViewpoints(*plan.frame.scene, kName);
    injection_.plan(plan, kName, params_, {Surfels::kChunk, false, params_.bounces > 0}, plan[voxels_]);
    shadowMap_.plan(plan, params_.shadowResolution);
}

void InjectShadowMap::record(PassContext& context) {
    const PathScene scene{context[voxels_], sources_};
    const Surfels& surfels = context[surfels_];
    VoxelIrradiance& irradiance = context[irradiance_];
    const SceneState& state = *context.frame.scene;
    CommandStream& stream = context.stream;
    injection_.begin(context, scene, irradiance);
    std::vector<Buffer> direct;
    for (const Surfels::Chunk& chunk : surfels.chunks) {
        direct.emplace_back(context.device, "surfels' direct irradiance", chunk.count * 4 * sizeof(float));
        stream.fill(direct.back(), 0);
    }

    for (const LightSource& source : sources_) {
        const std::vector<gpu::LightView> views = lightViews(state.lights[source.light], state.geometry);
        for (uint32_t v = 0; v < views.size(); ++v) {
            shadowMap_.draw(context, views[v]);
            const uint32_t side = views.size() == kCubeSides ? v : kCubeSides;
            for (size_t c = 0; c < surfels.chunks.size(); ++c) {
                const Surfels::Chunk& chunk = surfels.chunks[c];
                context.dispatch(lightSurfels_, chunk.count,
                                 {context.scene,
                                  {"surfels", chunk.surfels},
                                  {"direct", direct[c]},
                                  shadowMap_.binding(),
                                  {"view", views[v]},
                                  {"light", source.light},
                                  {"resolution", params_.shadowResolution},
                                  {"side", side},
                                  {"count", chunk.count}});
            }
        }
    }

    const uint32_t seed = randomSeed(context.frame, context.frameIndex);
    for (size_t c = 0; c < surfels.chunks.size(); ++c)
        injection_.lightIndirect(context, scene, surfels.chunks[c].surfels, surfels.chunks[c].count, params_,
                                 seed, direct[c]);
    injection_.finish(context, scene.voxels, irradiance);
    requireLight(stream, scene.voxels, irradiance, *context.frame.scene);
    injection_.fillUnknown(context, scene.voxels, irradiance);
}

VOXRAY_REGISTER_PASS(InjectShadowMap);

}  // namespace voxray
