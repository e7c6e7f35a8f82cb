#include <vector>

#include "graph/registry.h"
#include "passes/common/lights/rsm.h"

namespace voxray {

/// Reflective shadow maps (Dachsbacher and Stamminger 2005) of all punctual lights, for virtual lights and
/// shadows.
class RenderRsm final : public Pass {
 public:
    static constexpr const char* kName = "render_rsm";
    static constexpr const char* kHelp =
        "Rasterizes the scene from every light into reflective shadow maps (RSM). "
        "These store the surface point of each texel, for sample_vpls and direct_shadow_maps. "
        "Point lights take a cube of six views, spots one (wider than 90° across: "
        "the cube), directional lights one over the scene's bounding sphere. "
        "No emissive surfaces and no environment: they have no single viewpoint. Biased by: rsm_resolution. "
        "Sees nothing nearer to a light than 0.0001 of the scene's extent. Source: Dachsbacher and Stamminger 2005.";
    struct Params {
        uint32_t rsmResolution = 512;
        static constexpr auto schema() {
            return std::tuple{
                field("rsm_resolution", &Params::rsmResolution, "Texels along an edge of each view.", 2u, 4096u)};
        }
    };

    explicit RenderRsm(const Params& params) : params_(params) {}
    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    static constexpr uint32_t kCubeFaces = 6;

    const Params params_;
    Out<Rsm> rsm_{*this, "rsm", "what each light sees"};
    RsmImage image_{*this};
    Buffer texels_;  ///< Of one view.
};

void RenderRsm::plan(PassPlan& plan) {
    const SceneState& state = *plan.frame.scene;
    Rsm& rsm = plan[rsm_];
    rsm.resolution = params_.rsmResolution;
    rsm.sources = requirePunctualLights(state, kName, "direct_shadow_rays, and 'first: light_rays' of sample_vpls");
    rsm.firstView = {0};
    for (const LightSource& source : rsm.sources)
        rsm.firstView.push_back(rsm.firstView.back() +
                                uint32_t(lightViews(state.lights[source.light], state.geometry).size()));
    // Shaders number texels by 32 bits
    if (const uint64_t texels = uint64_t(rsm.firstView.back()) * rsm.texelsPerView(); texels > UINT32_MAX)
        throw Error("{}: {} views of lights, {}x{} texels each, are more than 2^32 texels; lower 'rsm_resolution'",
                    kName, rsm.firstView.back(), rsm.resolution, rsm.resolution);
    const uint64_t bytes = uint64_t(rsm.texelsPerView()) * sizeof(gpu::RsmTexel);
    image_.plan(plan, rsm.resolution);
    plan.scratchBuffer(texels_, "a reflective shadow map's texels", bytes);
    plan.buffer(rsm.views, "lights' views", rsm.firstView.back() * sizeof(gpu::RsmView));
    plan.buffer(rsm.texels, "reflective shadow maps", rsm.firstView.back() * bytes);
}

void RenderRsm::record(PassContext& context) {
    const SceneState& state = *context.frame.scene;
    const Rsm& rsm = context[rsm_];
    CommandStream& stream = context.stream;
    std::vector<gpu::RsmView> views;
    for (const LightSource& source : rsm.sources) {
        const auto sourceViews = lightViews(state.lights[source.light], state.geometry);
        for (uint32_t v = 0; v < sourceViews.size(); ++v)
            views.push_back({sourceViews[v], source.light, sourceViews.size() == kCubeFaces ? v : kCubeFaces});
    }
    stream.upload(rsm.views, views);
    for (size_t v = 0; v < views.size(); ++v) {
        image_.draw(context, views[v].view);
        stream.copy(image_.image(), texels_);
        stream.copy(texels_, rsm.texels, texels_.bytes(), 0, v * texels_.bytes());
    }
}

VOXRAY_REGISTER_PASS(RenderRsm);

}  // namespace voxray
