#pragma once

#include <optional>

#include "passes/common/compute/compaction.h"
#include "passes/common/light_paths/light_emission.h"
#include "passes/common/vpls/vpls.h"

namespace voxray {

/// Virtual point lights at the vertices of paths from the lights (instant radiosity, Keller 1997), which is
/// where Sun and Agu 2015, section 3.2, put those of the second and further bounces.
class SampleVpls final : public Pass {
 public:
    static constexpr const char* kName = "sample_vpls";
    static constexpr const char* kHelp =
        "Virtual point lights where rays from the lights hit, bounce after bounce: what gather_vpls sends "
        "indirect light from. Lights of every kind send rays by their power. All surfaces are Lambert "
        "surfaces "
        "of their base colour. Biased by: shading normals, whose factor on light paths is left out. Noisy "
        "by: vpls_per_bounce. Each frame draws the same numbers, so that virtual lights move with a light. "
        "Source: Keller 1997; Sun and Agu 2015, section 3.2.";
    struct Params {
        uint32_t vplsPerBounce = 1024;
        uint32_t bounces = 3;
        static constexpr auto schema() {
            return std::tuple{
                field("vpls_per_bounce", &Params::vplsPerBounce,
                      "Paths of light. Each leaves a virtual point light at each of its hits, until Russian "
                      "roulette by albedo ends it. Each light sends at least one.",
                      1u, 1u << 20),
                field("bounces", &Params::bounces, "Bounces of light: hits of a path that count.", 1u, 16u)};
        }
    };

    explicit SampleVpls(const Params& params) : params_(params) {}
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    Params params_;
    Port<Vpls> vpls_;
    std::vector<uint32_t> pathsOf_;  ///< Each source's.
    LightEmission emission_;
    Program record_;
    std::optional<Compaction> compaction_;
    Buffer rays_, hits_, paths_, order_, flags_;
};

}  // namespace voxray
