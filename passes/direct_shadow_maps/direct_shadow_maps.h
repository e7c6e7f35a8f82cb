#pragma once

#include "passes/common/lights/rsm.h"
#include "passes/common/view/frame_image.h"
#include "passes/common/view/gbuffer.h"

namespace voxray {

/// Direct light per pixel by shadow maps (Williams 1978): each texel of the g-buffer is tested against what
/// the lights' views see, with percentage-closer filtering over 2x2 texels (Reeves et al. 1987).
class DirectShadowMaps final : public Pass {
 public:
    static constexpr const char* kName = "direct_shadow_maps";
    static constexpr const char* kHelp =
        "Direct light of point, spot and directional lights by shadow maps, those of render_rsm. Biased by: "
        "rsm_resolution, at edges of shadows by about a texel, contacts within half a texel. No noise. "
        "Mirrors reflect no light. Compare with direct_shadow_rays. Source: Williams 1978; filtering: Reeves "
        "et al. 1987; as Sun and Agu 2015, section 3.2.";
    struct Params {
        static constexpr auto schema() { return std::tuple{}; }
    };

    explicit DirectShadowMaps(const Params&) {}
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    Port<const GBuffer> gbuffer_;
    Port<const Rsm> rsm_;
    Port<FrameImage> direct_;
    Program shade_;
    Sampler sampler_;
};

}  // namespace voxray
