#pragma once

#include "passes/common/radiance/cone_sets.h"
#include "passes/common/radiance/radiance_voxels.h"
#include "passes/common/surfels/surfels.h"

namespace voxray {

/// Irradiance by cones at points that stay where they are on the surfaces, whatever the camera does, and how
/// it changes from frame to frame. In a scene at rest a change is the method's own: a clipmap's levels that
/// follow the camera, a window that scrolls. Random numbers are each point's own, the same in every frame.
class ProbeIrradiance final : public Pass {
 public:
    static constexpr const char* kName = "probe_irradiance";
    static constexpr const char* kHelp =
        "Measures irradiance by cones at points that stand still on the surfaces and reports, for each "
        "frame, its mean (W/m²) and its change since the last one over that mean: on average over the points "
        "and where it is largest. Tests stability: with a moving camera and all else at rest the change is "
        "the method's own. Surfaces may not move: points could not be told apart.";
    struct Params {
        uint32_t maxPoints = 1024;
        uint32_t cones = 6;
        uint32_t coneSets = 16;
        static constexpr auto schema() {
            return std::tuple{
                field("max_points", &Params::maxPoints,
                      "Largest number of points, taken from those of place_surfels.", 1u, 1u << 20),
                field("cones", &Params::cones, "Cones from each point.", coneSetSizes()),
                field("cone_sets", &Params::coneSets,
                      "Sets of cones from each point, whose directions and levels are shifted against each "
                      "other. gather_cones sends one from a texel and takes the mean over some 25 texels.",
                      1u, 256u)};
        }
    };

    explicit ProbeIrradiance(const Params& params) : params_(params) {}
    Phase phase() const override { return Phase::Frame; }
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    /// Every so many-th surfel is a point. Odd, so that both sides of surfaces have their turn.
    uint32_t stride(const Surfels& surfels) const;

    Params params_;
    Port<const Surfels> surfels_;
    Port<const RadianceVoxels> radiance_;
    Program gather_;
    Buffer cones_, irradiance_;
    std::vector<glm::vec4> last_;  ///< As `irradiance_` was in the last frame.
};

}  // namespace voxray
