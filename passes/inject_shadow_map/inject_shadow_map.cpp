#include "passes/inject_shadow_map/inject_shadow_map.h"

#include "passes/common/compute/dispatch.h"
#include "passes/common/compute/random_seed.h"
#include "passes/common/lights/pane_tint.h"

namespace voxray {
namespace {

constexpr uint32_t kCubeSides = 6;

struct LightPush {
    gpu::LightView view;
    uint32_t light;
    uint32_t resolution;
    uint32_t side;
    uint32_t count;
};

}  // namespace

void InjectShadowMap::declare(PassBuilder& builder) {
    voxels_ = builder.read<SurfaceVoxels>("voxels", "surface voxels to light");
    surfels_ = builder.read<Surfels>("surfels", "points where irradiance is measured");
    irradiance_ = builder.write<VoxelIrradiance>("irradiance", "light that arrives at the voxels' surfaces");
}

void InjectShadowMap::plan(PassPlan& plan) {
    requireClearPanes(*plan.frame.scene, kName);
    plan.get(irradiance_).lightBounces = params_.bounces;
    sources_ = requireViewpoints(*plan.frame.scene, kName);
    injection_.plan(plan, kName, params_, {Surfels::kChunk, false, params_.bounces > 0}, plan.get(voxels_));
    shadowMap_.plan(plan, params_.shadowResolution);
    plan.reserveScratch("surfels' direct irradiance (estimated)",
                        plan.get(surfels_).maxCount * 4 * sizeof(float));
}

void InjectShadowMap::prepare(PassSetup& setup) {
    shadowMap_.prepare(setup);
    lightSurfels_ = makeComputeProgram(setup.device,
                                       setup.compiler.compile("passes/inject_shadow_map/light_surfels.comp"));
    injection_.prepare(setup);
}

void InjectShadowMap::record(PassContext& context) {
    const PathScene scene{context.get(voxels_), sources_};
    const Surfels& surfels = context.get(surfels_);
    VoxelIrradiance& irradiance = context.get(irradiance_);
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
                stream.dispatch(
                    lightSurfels_,
                    context.scene.bindings(
                        {{"surfels", chunk.surfels}, {"direct", direct[c]}, shadowMap_.binding()}),
                    LightPush{views[v], source.light, params_.shadowResolution, side, chunk.count},
                    linearGroups(chunk.count));
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

}  // namespace voxray
