#include "passes/inject/inject_voxel_rays/shadow_map_light.h"

namespace voxray {

ShadowMapLight::ShadowMapLight(ProgramOwner& owner) : test_(owner, "test_shadow_map.comp"), map_(owner) {}

void ShadowMapLight::plan(PassPlan& plan, uint32_t resolution) {
    resolution_ = resolution;
    map_.plan(plan, resolution);
}

std::vector<Buffer> ShadowMapLight::measure(PassContext& context, const std::vector<LightSource>& sources,
                                            const Surfels& surfels) const {
    const SceneState& state = *context.frame.scene;
    std::vector<Buffer> direct;
    for (const Surfels::Chunk& chunk : surfels.chunks) {
        direct.emplace_back(context.device, "surfels' direct irradiance", chunk.count * 4 * sizeof(float));
        context.stream.fill(direct.back(), 0);
    }
    for (const LightSource& source : sources) {
        const std::vector<gpu::LightView> views = lightViews(state.lights[source.light], state.geometry);
        for (uint32_t v = 0; v < views.size(); ++v) {
            map_.draw(context, views[v]);
            const uint32_t face = views.size() == kCubeFaces ? v : kCubeFaces;
            for (size_t c = 0; c < surfels.chunks.size(); ++c) {
                const Surfels::Chunk& chunk = surfels.chunks[c];
                context.dispatch(test_, chunk.count,
                                 {context.scene,
                                  {"surfels", chunk.surfels},
                                  {"direct", direct[c]},
                                  map_.binding(),
                                  {"view", views[v]},
                                  {"light", source.light},
                                  {"resolution", resolution_},
                                  {"face", face},
                                  {"count", chunk.count}});
            }
        }
    }
    return direct;
}

}  // namespace voxray
