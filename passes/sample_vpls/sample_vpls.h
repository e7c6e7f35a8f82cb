#pragma once

#include <optional>

#include "passes/common/compute/compaction.h"
#include "passes/common/light_paths/light_emission.h"
#include "passes/common/lights/pane_tint.h"
#include "passes/common/voxel_march/voxel_tracer.h"
#include "passes/common/vpls/vpls.h"
#include "passes/sample_vpls/rsm_sampling.h"

namespace voxray {

/// How the first vertices of paths of light are found.
enum class FirstVertices { LightRays, Rsm };
template <>
struct EnumNames<FirstVertices> {
    static constexpr std::array names{std::pair{FirstVertices::LightRays, "light_rays"},
                                      std::pair{FirstVertices::Rsm, "rsm"}};
};

/// What rays of the second bounce and further ones meet.
enum class VplBounce { Exact, Svo };
template <>
struct EnumNames<VplBounce> {
    static constexpr std::array names{std::pair{VplBounce::Exact, "exact"}, std::pair{VplBounce::Svo, "svo"}};
};

/// Virtual point lights at the vertices of paths from the lights (instant radiosity, Keller 1997); with
/// FirstVertices::Rsm as Sun and Agu 2015, sections 3 and 3.2: the first out of reflective shadow maps by
/// importance, further ones by rays from there.
class SampleVpls final : public Pass {
 public:
    static constexpr const char* kName = "sample_vpls";
    static constexpr const char* kHelp =
        "Virtual point lights where rays from the lights hit, bounce after bounce: what gather_vpls sends "
        "indirect light from. Lights of every kind send rays by their power. All surfaces are Lambert "
        "surfaces "
        "of their base colour. Biased by: shading normals, whose factor on light paths is left out; voxel "
        "size "
        "with 'bounce: svo'. Noisy by: vpls_per_bounce. Each frame draws the same numbers, so that virtual "
        "lights move with a light, "
        "unless "
        "'resample' is set. "
        "Source: Keller 1997; Sun and Agu 2015, section 3.2.";
    struct Params {
        uint32_t vplsPerBounce = 1024;
        uint32_t bounces = 3;
        FirstVertices first = FirstVertices::LightRays;
        VplBounce bounce = VplBounce::Exact;
        bool resample = false;
        static constexpr auto schema() {
            return std::tuple{
                field("vpls_per_bounce", &Params::vplsPerBounce,
                      "Paths of light. Each leaves a virtual point light at each of its hits, until Russian "
                      "roulette by albedo ends it. Each light sends at least one.",
                      1u, 1u << 24)
                    .lessNoise(),
                field("bounces", &Params::bounces, "Bounces of light: hits of a path that count.", 1u, 16u),
                field("first", &Params::first,
                      "Where paths begin. light_rays: where rays from lights of every kind hit, which carry "
                      "equal "
                      "power. rsm: at texels of reflective shadow maps (render_rsm), picked by the flux that "
                      "their points reflect; point, spot and directional lights alone."),
                field("bounce", &Params::bounce,
                      "What rays from one virtual light to the next meet. exact: triangles. svo: surface "
                      "voxels, "
                      "and virtual lights past the first bounce stand before them, with the voxel's mean "
                      "normal and albedo."),
                field("resample", &Params::resample,
                      "Whether each frame draws numbers of its own, for comparison: virtual lights then "
                      "jump.")};
        }
    };

    explicit SampleVpls(const Params& params) : params_(params) {}
    Phase phase() const override { return params_.resample ? Phase::Frame : Phase::Build; }
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    Params params_;
    Port<const Rsm> rsm_;               ///< With FirstVertices::Rsm.
    Port<const SurfaceVoxels> voxels_;  ///< With VplBounce::Svo.
    Port<Vpls> vpls_;
    std::vector<LightSource> sources_;  ///< Those that shone when paths were divided among them.
    std::vector<uint32_t> pathsOf_;     ///< Each one's.
    LightEmission emission_;
    RsmSampling rsmSampling_;
    std::optional<VoxelTracer> voxelTracer_;  ///< With VplBounce::Svo.
    Program record_, recordVoxels_;           ///< Hits of triangles, and of voxels.
    std::optional<Compaction> compaction_;
    Buffer rays_, hits_, paths_, order_, flags_;
    PaneTint tint_;
};

}  // namespace voxray
