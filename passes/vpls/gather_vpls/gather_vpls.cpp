#include <glm/gtc/constants.hpp>
#include <memory>
#include <optional>

#include "base/error.h"
#include "graph/registry.h"
#include "passes/common/filter/irradiance_resolve.h"
#include "passes/common/filter/noisy_irradiance.h"
#include "passes/common/view/gbuffer.h"
#include "passes/common/voxel_march/voxel_tracer.h"
#include "passes/hybrid_leaves/hybrid_tracer.h"
#include "passes/vpls/gather_vpls/compensation.h"
#include "passes/vpls/gather_vpls/cube_shadow_maps.h"
#include "passes/vpls/gather_vpls/imperfect_shadow_maps.h"
#include "passes/vpls/gather_vpls/traced_shadow_maps.h"

namespace voxray {

/// How the visibility of virtual point lights is tested.
enum class VplVisibility {
    Svo,
    SvoRestart,
    Bricks,
    Bits,
    HybridLeaves,
    CubeShadowMap,
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
                                      std::pair{VplVisibility::CubeShadowMap, "cube_shadow_map"},
                                      std::pair{VplVisibility::ShadowMap, "shadow_map"},
                                      std::pair{VplVisibility::ImperfectShadowMap, "imperfect_shadow_map"},
                                      std::pair{VplVisibility::Exact, "exact"},
                                      std::pair{VplVisibility::None, "none"}};
};

/// Unit of the bound on near lights.
enum class VplBoundUnit { Disc, Meter };
template <>
struct EnumNames<VplBoundUnit> {
    static constexpr std::array names{std::pair{VplBoundUnit::Disc, "disc"}, std::pair{VplBoundUnit::Meter, "meter"}};
};

/// By what virtual lights count as dim.
enum class DimVpls { Irradiance, Power };
template <>
struct EnumNames<DimVpls> {
    static constexpr std::array names{std::pair{DimVpls::Irradiance, "irradiance"}, std::pair{DimVpls::Power, "power"}};
};

namespace {

/// How shadow rays traverse surface voxels; nullopt: visibility is not that of surface voxels.
std::optional<VoxelTraversal> voxelTraversal(VplVisibility visibility) {
    switch (visibility) {
        case VplVisibility::Svo:
            return VoxelTraversal::Svo;
        case VplVisibility::SvoRestart:
            return VoxelTraversal::SvoRestart;
        case VplVisibility::Bricks:
            return VoxelTraversal::Bricks;
        case VplVisibility::Bits:
            return VoxelTraversal::Bits;
        default:
            return std::nullopt;
    }
}

}  // namespace

/// Irradiance from virtual point lights, each texel from every n-th of them (interleaved sampling, Segovia et
/// al. 2006), with shadow rays through voxels. Source: Sun and Agu 2015, sections 3.1 and 3.2, equations 1 to
/// 4, which lack the 1/pi between flux and radiant intensity (docs/many-lights.md).
class GatherVpls final : public Pass {
 public:
    static constexpr const char* kName = "gather_vpls";
    static constexpr const char* kHelp =
        "Gathers indirect light from virtual point lights (VPLs) by shadow rays. "
        "Each texel of a block gathers from a different subset of the lights of sample_vpls; "
        "filter_irradiance should follow. Biased by: bound without compensation_rays, "
        "which darkens contacts and corners; voxel size or map_resolution, unless visibility is exact. "
        "Noisy by: the number of virtual lights, as blotches that all texels share. "
        "Source: Sun and Agu 2015; Kollig and Keller 2004.";
    struct Params {
        uint32_t block = 4;
        float bound = 1;
        VplBoundUnit boundUnit = VplBoundUnit::Disc;
        uint32_t compensationRays = 0;
        float roulette = 0;
        float earlyOut = 0;
        DimVpls earlyOutBy = DimVpls::Irradiance;
        VplVisibility visibility = VplVisibility::Svo;
        float restartEpsilon = 0;
        float endEpsilon = 0;
        uint32_t mapResolution = 128;
        uint32_t mapPoints = 8192;
        static constexpr auto schema() {
            return std::tuple{
                field("block", &Params::block,
                      "Texels along the edge of a block, over whose texels the virtual lights are divided.",
                      powersOfTwo(1, 16)),
                field("bound", &Params::bound,
                      "Distance below which virtual lights get no brighter, in bound_unit. 0: no bound.", 0.0f,
                      1000.0f),
                field("bound_unit", &Params::boundUnit,
                      "disc: radii of a disc with the area of all surfaces divided by the number of light paths, "
                      "so that the bound shrinks as lights are added. "
                      "meter: constant, the root of B in Sun and Agu 2015, equation 2.")
                    .onlyWith(noneOf(&Params::bound, {0.0f})),
                field("compensation_rays", &Params::compensationRays,
                      "Rays per texel that restore the light that 'bound' takes away, "
                      "so that it is no bias but noise near contacts; 0: none.",
                      0u, 256u)
                    .onlyWith(noneOf(&Params::bound, {0.0f})),
                field("roulette", &Params::roulette,
                      "Russian roulette of shadow rays: "
                      "virtual lights whose unoccluded light at a texel is less than this times the mean "
                      "of the texel's lights get a ray with a probability in proportion to it. "
                      "Saves rays for noise; 0: none.",
                      0.0f, 100.0f),
                field("early_out", &Params::earlyOut,
                      "Virtual lights that are dimmer than this times the mean of the texel's lights are left out: "
                      "the image loses their light. 0: none are.",
                      0.0f, 100.0f)
                    .onlyWith(oneOf(&Params::roulette, {0.0f})),
                field(
                    "early_out_by", &Params::earlyOutBy,
                    "irradiance: unoccluded, at the texel. "
                    "power: the luminance of the light's flux, wherever the texel is (Sun and Agu 2015, section 3.2).")
                    .onlyWith(noneOf(&Params::earlyOut, {0.0f})),
                field("visibility", &Params::visibility,
                      "What occludes virtual lights. "
                      "svo, bricks, bits: surface voxels, by three traversals with equal results. "
                      "svo_restart: surface voxels, by the paper's traversal. hybrid_leaves: "
                      "triangles and grids in the leaves of an octree (build_hybrid_leaves). cube_shadow_map: "
                      "a cube shadow map of each virtual light, rasterized. shadow_map: "
                      "a shadow map of each virtual light's hemisphere, by a ray per texel. imperfect_shadow_map: "
                      "the same, splatted from points (Ritschel et al. 2008). exact: triangles. none: nothing."),
                field("restart_epsilon", &Params::restartEpsilon,
                      "Voxels by which the traversal steps past each node, as in the paper, "
                      "which skips thinner nodes; 0 steps exactly.",
                      0.0f, 1.0f)
                    .onlyWith(oneOf(&Params::visibility, {VplVisibility::SvoRestart})),
                field("end_epsilon", &Params::endEpsilon,
                      "Voxels by which a shadow ray is shortened at both ends, as in the paper; "
                      "0 moves the ends out of their surfaces' voxels along normals.",
                      0.0f, 64.0f)
                    .onlyWith(oneOf(&Params::visibility, {VplVisibility::SvoRestart})),
                field("map_resolution", &Params::mapResolution,
                      "Texels along an edge of a virtual light's shadow map; of a cube's face.", 4u, 1024u)
                    .onlyWith(oneOf(&Params::visibility, {VplVisibility::CubeShadowMap, VplVisibility::ShadowMap,
                                                          VplVisibility::ImperfectShadowMap})),
                field("map_points", &Params::mapPoints,
                      "Points of the scene's surfaces that each map is splatted from.", 64u, 1u << 20)
                    .onlyWith(oneOf(&Params::visibility, {VplVisibility::ImperfectShadowMap}))};
        }
    };

    explicit GatherVpls(const Params& params);
    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    const Params params_;
    In<GBuffer> gbuffer_{*this, "gbuffer", "what the camera sees"};
    In<Vpls> vpls_{*this, "vpls", "virtual point lights"};
    const std::optional<VoxelTraversal> traversal_ = voxelTraversal(params_.visibility);
    In<SurfaceVoxels> voxels_{*this, "voxels",
                              traversal_ ? "what occludes shadow rays" : "voxels whose octree shadow rays traverse",
                              traversal_ || params_.visibility == VplVisibility::HybridLeaves};
    In<HybridLeaves> leaves_{*this, "hybrid_leaves", "what occludes shadow rays",
                             params_.visibility == VplVisibility::HybridLeaves};
    Out<NoisyIrradiance> noisy_{*this, "noisy_irradiance", "irradiance from a subset of lights a texel"};
    Out<FrameImage> indirect_{*this, "indirect", "radiance reflected of indirect light, unfiltered"};
    std::optional<VoxelTracer> voxelTracer_;
    std::optional<HybridTracer> hybridTracer_;
    std::unique_ptr<VplShadowMaps> shadowMaps_;  ///< For all kinds of shadow maps.
    VplGather vplGather_{*this};
    std::optional<VplCompensation> compensation_;  ///< Where a bound takes light away and rays restore it.
    Image texelMoments_;                           ///< Of the G-buffer's extent.
    Kernel resolveMoments_{*this, "resolve_moments.comp"};
    std::optional<IrradianceResolve> resolve_;  ///< Where `indirect` is read.
};

GatherVpls::GatherVpls(const Params& params) : params_(params) {
    if (traversal_) voxelTracer_.emplace(*this, *traversal_, params_.restartEpsilon);
    if (params_.visibility == VplVisibility::HybridLeaves) hybridTracer_.emplace(*this, HybridTraversal::Hierarchical);
    if (params_.visibility == VplVisibility::CubeShadowMap)
        shadowMaps_ = std::make_unique<CubeShadowMaps>(*this, params_.mapResolution);
    if (params_.visibility == VplVisibility::ShadowMap)
        shadowMaps_ = std::make_unique<TracedShadowMaps>(*this, params_.mapResolution);
    if (params_.visibility == VplVisibility::ImperfectShadowMap)
        shadowMaps_ = std::make_unique<ImperfectShadowMaps>(*this, params_.mapResolution, params_.mapPoints);
}

void GatherVpls::plan(PassPlan& plan) {
    const Vpls& vpls = plan[vpls_];
    const uint32_t samples = plan[gbuffer_].samples;
    const glm::uvec2 texels = gbufferExtent(plan.frame, samples);
    // Moving surfaces keep their area
    const float discRadiusSquared = vpls.areaPerPath / glm::pi<float>();
    const float minDistanceSquared =
        params_.bound * params_.bound * (params_.boundUnit == VplBoundUnit::Disc ? discRadiusSquared : 1);
    const bool isCompensated = params_.compensationRays > 0 && minDistanceSquared > 0;
    if (shadowMaps_) shadowMaps_->plan(plan);
    const bool usesRoulette = params_.roulette > 0;
    const VplGather::DimLights earlyOut =
        params_.earlyOutBy == DimVpls::Power ? VplGather::DimLights::LeftOutByPower : VplGather::DimLights::LeftOut;
    const VplGather::DimLightCulling culling{usesRoulette ? params_.roulette : params_.earlyOut,
                                             usesRoulette ? VplGather::DimLights::Sampled : earlyOut};
    const float endEpsilon = params_.visibility == VplVisibility::SvoRestart ? params_.endEpsilon : 0;
    vplGather_.plan(plan,
                    {params_.block, minDistanceSquared, culling, endEpsilon, shadowMaps_.get(), isCompensated,
                     hybridTracer_.has_value()},
                    texels, uint64_t(vpls.paths) * vpls.bounces);
    if (isCompensated)
        compensation_.emplace(*this).plan(plan, {params_.compensationRays, vpls.bounces, minDistanceSquared}, texels);
    NoisyIrradiance& noisy = plan[noisy_];
    noisy.blockSize = params_.block;
    noisy.lightBounces = plan[indirect_].lightBounces = vpls.lightBounces;
    plan.image(noisy.irradiance, "noisy irradiance", NoisyIrradiance::desc(plan.frame, samples));
    plan.image(texelMoments_, "sums over virtual point lights", NoisyIrradiance::desc(plan.frame, samples));
    plan.buffer(noisy.moments, "moments of virtual point lights", noisy.momentsBytes(texels));
    if (FrameImage& indirect = plan[indirect_]; indirect.isRead) {
        plan.frameImage(indirect_);
        resolve_.emplace(*this);
    }
    if (voxelTracer_) voxelTracer_->plan(plan, plan[voxels_]);
    if (hybridTracer_) hybridTracer_->plan(plan, plan[voxels_]);
}

void GatherVpls::record(PassContext& context) {
    CommandStream& stream = context.stream;
    const GBuffer& gbuffer = context[gbuffer_];
    const Vpls& vpls = context[vpls_];
    const NoisyIrradiance& noisy = context[noisy_];
    VplGather::Visibility visibility{&context.tracer};
    if (params_.visibility == VplVisibility::None) visibility.tracer = nullptr;
    if (shadowMaps_) shadowMaps_->beginFrame(context, vpls);
    if (voxelTracer_) {
        const SurfaceVoxels& voxels = context[voxels_];
        voxelTracer_->begin(stream, voxels);
        visibility = {&*voxelTracer_, voxels.grid};
    }
    if (hybridTracer_) {
        hybridTracer_->begin(stream, context.scene, context[voxels_], context[leaves_]);
        hybridTracer_->setStarts(&vplGather_.starts());
        visibility.tracer = &*hybridTracer_;
    }
    const uint64_t voxelRaysBefore = voxelTracer_ ? voxelTracer_->raysTraced() : 0;
    const uint64_t hybridRaysBefore = hybridTracer_ ? hybridTracer_->raysTraced() : 0;

    // Sum over virtual lights, and what the bound takes away
    const VplTarget target{noisy.irradiance, texelMoments_};
    stream.clear(target.irradiance, {});
    stream.clear(target.texelMoments, {});
    vplGather_.gatherAtTexels(context, vpls, visibility, gbuffer, target);
    if (compensation_) compensation_->record(context, vpls, vplGather_, visibility, gbuffer, target);
    const glm::uvec2 blocks = noisy.blocks(gbufferExtent(context.frame, gbuffer.samples));
    context.dispatch(resolveMoments_, uint64_t(blocks.x) * blocks.y,
                     {gbuffer,
                      {"irradiance", noisy.irradiance},
                      {"texelMoments", texelMoments_},
                      {"moments", noisy.moments},
                      {"blocks", blocks},
                      {"block", params_.block}});
    if (voxelTracer_) {
        context.extraRays += voxelTracer_->raysTraced() - voxelRaysBefore;
        context.marchCounters.push_back(&voxelTracer_->march().counts());
    }
    if (hybridTracer_) {
        context.extraRays += hybridTracer_->raysTraced() - hybridRaysBefore;
        context.marchCounters.push_back(&hybridTracer_->counts());
    }
    if (resolve_) resolve_->record(context, gbuffer, noisy.irradiance, context[indirect_].image);
}

VOXRAY_REGISTER_PASS(GatherVpls);

}  // namespace voxray
