#include "graph/registry.h"
#include "passes/common/lights/pane_transmittance.h"
#include "passes/common/lights/rsm.h"
#include "passes/common/view/gbuffer.h"

namespace voxray {

/// Direct light by shadow maps (Williams 1978): each texel of the G-buffer is tested against the depth in the
/// lights' views, with percentage-closer filtering over 2x2 texels (Reeves et al. 1987).
class DirectShadowMaps final : public Pass {
 public:
    static constexpr const char* kName = "direct_shadow_maps";
    static constexpr const char* kHelp =
        "Computes direct light at each pixel by shadow maps. "
        "The lights are point, spot and directional lights, and the maps are those of render_rsm. "
        "Biased by: rsm_resolution, at edges of shadows by about a texel, at contacts within half a texel. No noise. "
        "Mirrors reflect no light. Compare with direct_shadow_rays. Source: Williams 1978; filtering: Reeves et al. "
        "1987; as Sun and Agu 2015, section 3.2.";

    void plan(PassPlan& plan) override {
        requireClearPanes(*plan.frame.scene, kName);
        plan.frameImage(direct_);
    }
    void record(PassContext& context) override {
        const Rsm& rsm = context[rsm_];
        context.dispatch(shade_, context.frame.pixels(),
                         {context.scene,
                          context[gbuffer_],
                          rsm,
                          {"direct", context[direct_].image},
                          {"resolution", rsm.resolution},
                          {"views", rsm.firstView.back()},
                          {"camera", context.frame.camera.position}});
    }

 private:
    In<GBuffer> gbuffer_{*this, "gbuffer", "what the camera sees"};
    In<Rsm> rsm_{*this, "rsm", "what lights see"};
    Out<FrameImage> direct_{*this, "direct", "radiance reflected of direct light"};
    Kernel shade_{*this, "shade.comp"};
};
VOXRAY_REGISTER_PASS(DirectShadowMaps);

}  // namespace voxray
