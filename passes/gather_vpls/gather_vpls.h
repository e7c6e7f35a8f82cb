#pragma once

#include <memory>
#include <optional>

#include "passes/common/filter/irradiance_resolve.h"
#include "passes/common/filter/noisy_irradiance.h"
#include "passes/common/hybrid_leaves/hybrid_tracer.h"
#include "passes/common/voxel_march/voxel_tracer.h"
#include "passes/gather_vpls/compensation.h"

namespace voxray {

/// What hides a virtual point light from a surface.
enum class VplVisibility {
    Svo,
    SvoRestart,
    Bricks,
    Bits,
    HybridLeaves,
    ShadowMap,
    ImperfectShadowMap,
    Exact,
    None
};
template <>
struct EnumNames<VplVisibility> {
    static constexpr std::array names{std::pair{VplVisibility::Svo, "svo"},
                                      std::pair{VplVisibility::SvoRestart, "svo_restart"},
                                      std::pair{VplVisibility::Bricks, "bricks"},
                                      std::pair{VplVisibility::Bits, "bits"},
                                      std::pair{VplVisibility::HybridLeaves, "hybrid_leaves"},
                                      std::pair{VplVisibility::ShadowMap, "shadow_map"},
                                      std::pair{VplVisibility::ImperfectShadowMap, "imperfect_shadow_map"},
                                      std::pair{VplVisibility::Exact, "exact"},
                                      std::pair{VplVisibility::None, "none"}};
};

/// Irradiance from virtual point lights, each texel from every n-th of them (interleaved sampling, Segovia et
/// al. 2006), with shadow rays through voxels. Source: Sun and Agu 2015, sections 3.1 and 3.2, equations 1 to
/// 4; there without the 1/pi that makes radiant intensity of flux (docs/many-lights.md).
class GatherVpls final : public Pass {
 public:
    static constexpr const char* kName = "gather_vpls";
    static constexpr const char* kHelp =
        "Indirect light from virtual point lights (sample_vpls), with a shadow ray to each: through voxels, "
        "or "
        "exact. Each texel of a block takes another part of them; let filter_irradiance follow. Biased by: "
        "bound without compensation_rays, which darkens contacts and corners; voxel size or map_resolution, "
        "unless visibility is exact. Noisy by: the number of virtual lights, as blotches that all texels "
        "share. Source: Sun "
        "and Agu 2015; Kollig and Keller 2004.";
    struct Params {
        uint32_t block = 4;
        float bound = 1;
        uint32_t compensationRays = 0;
        float roulette = 0;
        float earlyOut = 0;
        VplVisibility visibility = VplVisibility::Svo;
        float restartEpsilon = 0;
        float endEpsilon = 0;
        uint32_t mapResolution = 128;
        uint32_t mapPoints = 8192;
        static constexpr auto schema() {
            return std::tuple{
                field("block", &Params::block,
                      "Texels along the edge of blocks whose texels share all virtual lights out among them.",
                      powersOfTwo(1, 16)),
                field(
                    "bound", &Params::bound,
                    "Virtual lights nearer than this give no more light than at it: factor of the radius of "
                    "the disc that has as much area as there is surface for each path of light. 0: no bound.",
                    0.0f, 1000.0f),
                field("compensation_rays", &Params::compensationRays,
                      "Rays of each texel that bring back what 'bound' takes away, which is then no bias but "
                      "noise near contacts; 0: it is left out.",
                      0u, 256u)
                    .onlyWith(noneOf(&Params::bound, {0.0f})),
                field(
                    "roulette", &Params::roulette,
                    "Virtual lights that, were nothing in the way, would bring a texel less than this times "
                    "what its lights do on average, get a shadow ray with a chance in proportion, and "
                    "count "
                    "for more by as much. Saves rays for noise; 0: each gets one that faces the texel.",
                    0.0f, 100.0f),
                field("early_out", &Params::earlyOut,
                      "As 'roulette', but such virtual lights are left out altogether, as the paper does: "
                      "the image is darker by what they would bring. 0: none is.",
                      0.0f, 100.0f)
                    .onlyWith(oneOf(&Params::roulette, {0.0f})),
                field("visibility", &Params::visibility,
                      "What hides virtual lights. svo, bricks, bits: surface voxels, on three walks that "
                      "find the same ones. svo_restart: these by the paper's walk. hybrid_leaves: triangles "
                      "and grids that the octree's leaves hold (build_hybrid_leaves). shadow_map: what a map "
                      "of each virtual light's hemisphere sees, by a ray a texel. imperfect_shadow_map: the "
                      "same, made of points (Ritschel et al. 2008). exact: triangles. none: nothing."),
                field("restart_epsilon", &Params::restartEpsilon,
                      "Voxels by which the walk steps past each node, as the paper does, which skips what is "
                      "thinner; 0 steps exactly.",
                      0.0f, 1.0f)
                    .onlyWith(oneOf(&Params::visibility, {VplVisibility::SvoRestart})),
                field("end_epsilon", &Params::endEpsilon,
                      "Voxels by which both ends of a shadow ray are moved along it, as the paper does; 0 "
                      "moves them out of their surfaces' voxels along normals.",
                      0.0f, 64.0f)
                    .onlyWith(oneOf(&Params::visibility, {VplVisibility::SvoRestart})),
                field("map_resolution", &Params::mapResolution,
                      "Texels along each side of a virtual light's map.", 4u, 1024u)
                    .onlyWith(oneOf(&Params::visibility,
                                    {VplVisibility::ShadowMap, VplVisibility::ImperfectShadowMap})),
                field("map_points", &Params::mapPoints,
                      "Points of the scene's surfaces that each map is made of.", 64u, 1u << 20)
                    .onlyWith(oneOf(&Params::visibility, {VplVisibility::ImperfectShadowMap}))};
        }
    };

    explicit GatherVpls(const Params& params) : params_(params) {}
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    Params params_;
    Port<const GBuffer> gbuffer_;
    Port<const Vpls> vpls_;
    Port<const SurfaceVoxels> voxels_;  ///< Where shadow rays walk through voxels.
    Port<const HybridLeaves> leaves_;   ///< Where they meet what these hold.
    Port<NoisyIrradiance> noisy_;
    Port<FrameImage> indirect_;
    std::optional<VoxelTracer> voxelTracer_;
    std::optional<HybridTracer> hybridTracer_;
    std::unique_ptr<VplMaps> maps_;  ///< With shadow maps of either kind.
    VplLight light_;
    std::optional<VplCompensation> compensation_;  ///< Where something is taken away and comes back.
    Image sums_;                                   ///< Of the G-buffer's extent.
    Program finish_;
    IrradianceResolve resolve_;
    Sampler sampler_;
};

}  // namespace voxray
