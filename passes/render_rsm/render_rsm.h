#pragma once

#include "passes/common/lights/rsm.h"

namespace voxray {

/// Reflective shadow maps (Dachsbacher and Stamminger 2005): the scene as each light sees it, for passes that
/// take their virtual lights or their shadows from there.
class RenderRsm final : public Pass {
 public:
    static constexpr const char* kName = "render_rsm";
    static constexpr const char* kHelp =
        "Rasterises the scene from every light: which point each texel sees (reflective shadow maps), for "
        "sample_vpls and direct_shadow_maps. Point lights take a cube of six views, spots one (wider than "
        "90° "
        "across: the cube), directional lights one over the scene's bounding sphere. No emissive surfaces "
        "and no environment: they have no single viewpoint. Biased by: rsm_resolution. Sees nothing nearer "
        "to a light than 0.0001 of the scene's extent. Source: Dachsbacher and Stamminger 2005.";
    struct Params {
        uint32_t rsmResolution = 512;
        static constexpr auto schema() {
            return std::tuple{field("rsm_resolution", &Params::rsmResolution,
                                    "Texels along an edge of each view.", 2u, 4096u)};
        }
    };

    explicit RenderRsm(const Params& params) : params_(params) {}
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    Params params_;
    Port<Rsm> rsm_;
    RsmImage image_;
    Buffer texels_;  ///< Of one view.
};

}  // namespace voxray
