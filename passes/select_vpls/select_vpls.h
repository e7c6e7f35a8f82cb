#pragma once

#include "graph/registry.h"
#include "passes/common/view/gbuffer.h"
#include "passes/common/vpls/vpls.h"

namespace voxray {

/// Of many virtual point lights those that light what the camera sees: each is kept with a probability by
/// what it brings to a few random texels, and counts for more by as much. Source: Georgiev and Slusallek
/// 2010, "Simple and Robust Iterative Importance Sampling of Virtual Point Lights".
class SelectVpls final : public Pass {
 public:
    static constexpr const char* kName = "select_vpls";
    static constexpr const char* kHelp =
        "Keeps a number of virtual point lights (sample_vpls) for gather_vpls, by what they bring to a few "
        "random texels, with exact shadow rays; those that stay count for more. No bias: any may stay. "
        "Noisy by: count; and points, which miss where a light is seen from few places. Source: Georgiev and "
        "Slusallek 2010.";
    struct Params {
        uint32_t count = 2048;
        uint32_t points = 32;
        float unseen = 0.1f;
        float bound = 1;
        static constexpr auto schema() {
            return std::tuple{
                field("count", &Params::count, "Virtual point lights that stay, at most.", 1u, 1u << 20)
                    .lessNoise(),
                field("points", &Params::points,
                      "Texels that each virtual light is tried on, others for each.", 1u, 1024u)
                    .lessNoise(),
                field(
                    "unseen", &Params::unseen,
                    "Fraction of 'count' that goes by flux alone, to virtual lights that these texels don't "
                    "see too. Smaller: they are rarer and brighter.",
                    0.001f, 1.0f),
                field("bound", &Params::bound,
                      "That of gather_vpls, so that virtual lights near the texels are weighed by what it "
                      "will let them bring. Another one biases nothing.",
                      0.0f, 1000.0f)};
        }
    };

    explicit SelectVpls(const Params& params) : params_(params) {}
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    /// Luminance of what each light of the list brings to a texel, W/m², and of its flux, W.
    std::vector<glm::vec2> importance(PassContext& context) const;

    Params params_;
    Port<const GBuffer> gbuffer_;
    Port<const Vpls> candidates_;
    Port<Vpls> vpls_;
    Program aim_, importanceProgram_, scale_;
    Sampler sampler_;
    Buffer rays_, carried_, occluded_, importance_, places_, weights_;
};

}  // namespace voxray
