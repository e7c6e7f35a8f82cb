#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "graph/registry.h"
#include "passes/common/compute/random_seed.h"
#include "passes/common/lights/pane_transmittance.h"
#include "passes/inject/inject_voxel_rays/hit_faces.h"
#include "passes/inject/inject_voxel_rays/shadow_map_light.h"
#include "passes/surfels/surfel_injection.h"

namespace voxray {

/// Which surfels are lit.
enum class VoxelRayPoints { All, GatherHits };

template <>
struct EnumNames<VoxelRayPoints> {
    static constexpr std::array names{std::pair{VoxelRayPoints::All, "all"},
                                      std::pair{VoxelRayPoints::GatherHits, "gather_hits"}};
};

/// How the direct light of surfels is measured.
enum class VoxelRayDirect { ShadowRays, ShadowMaps };

template <>
struct EnumNames<VoxelRayDirect> {
    static constexpr std::array names{std::pair{VoxelRayDirect::ShadowRays, "shadow_rays"},
                                      std::pair{VoxelRayDirect::ShadowMaps, "shadow_maps"}};
};

/// Irradiance at the voxels' surfels: direct light by shadow rays or shadow maps, indirect light by paths.
/// Source: Magalhães 2020, section 6.1, where rays read the voxels' light of the last frame at their hits;
/// lighting only what the view needs is from there, too.
class InjectVoxelRays final : public Pass {
 public:
    static constexpr const char* kName = "inject_voxel_rays";
    static constexpr const char* kHelp =
        "Lights voxels by shadow rays and paths from their surfels. "
        "Surfels are points on the voxels' surfaces (place_surfels). With `points: gather_hits` it lights "
        "in each frame only the faces that the rays of trace_gather_rays (which must come before) hit. "
        "With `direct: shadow_maps` direct light of surfels comes by each light's shadow map: "
        "point lights take a cube of six maps, spots one (wider than 90° across: "
        "the cube), directional lights one over the scene's bounding sphere; "
        "emissive surfaces and the environment have no single viewpoint and are refused. Biased by: voxel size; "
        "of shadow maps also shadow_resolution (shadow edges and gaps below a texel). Noisy by: "
        "points_per_voxel, paths_per_point. Leaves unlit: nothing; with gather_hits all that no gather ray hits. "
        "In shadow maps what lies nearer to a light than 0.0001 of the scene's extent casts no shadow. "
        "Source: Magalhães 2020, section 6.1; shadow maps: Arnebäck 2017.";
    struct Params : WriteParams {
        VoxelRayPoints points = VoxelRayPoints::All;
        VoxelRayDirect direct = VoxelRayDirect::ShadowRays;
        uint32_t shadowResolution = 1024;
        /// Enough for a lookup to beat a constant image (docs/injection.md).
        uint32_t pathsPerPoint = 16;
        uint32_t bounces = 8;
        uint32_t lightSamples = 1;

        bool byShadowMaps() const { return points == VoxelRayPoints::All && direct == VoxelRayDirect::ShadowMaps; }
        static constexpr auto schema() {
            return std::tuple_cat(
                std::tuple{field("points", &Params::points,
                                 "Which surfels are lit. all: those of every voxel. "
                                 "gather_hits: those on the faces that the frame's gather rays hit; "
                                 "few paths_per_point suffice, since a gather averages over many faces."),
                           field("direct", &Params::direct,
                                 "How direct light of surfels is measured. shadow_rays: by rays to the lights. "
                                 "shadow_maps: by a shadow map of each light.")
                               .onlyWith(oneOf(&Params::points, {VoxelRayPoints::All})),
                           field("shadow_resolution", &Params::shadowResolution,
                                 "Texels along an edge of each shadow map.", 2u, 8192u)
                               .onlyWith(oneOf(&Params::direct, {VoxelRayDirect::ShadowMaps}))},
                WriteParams::schema(),
                std::tuple{
                    field("paths_per_point", &Params::pathsPerPoint, "Paths from each point.", 1u, 1024u)
                        .lessNoise()
                        .onlyWith(noneOf(&Params::bounces, {0u})),
                    field("bounces", &Params::bounces, "Bounces of light; Russian roulette by albedo ends paths early.",
                          0u, 32u),
                    field("light_samples", &Params::lightSamples,
                          "Shadow rays from each point to the emissive surfaces, and to the environment.", 1u, 256u)
                        .onlyWith(oneOf(&Params::direct, {VoxelRayDirect::ShadowRays}),
                                  oneOf(&Params::points, {VoxelRayPoints::GatherHits}))});
        }
    };

    explicit InjectVoxelRays(const Params& params);
    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    /// Writes the irradiance of surfels to their voxels, the indirect one by paths. @param direct W/m², 4
    /// floats each.
    void inject(PassContext& context, const PathScene& scene, const Buffer& surfels, uint32_t count,
                const Buffer& direct);

    const Params params_;
    const bool onlyHits_ = params_.points == VoxelRayPoints::GatherHits;
    In<SurfaceVoxels> voxels_{*this, "voxels", "surface voxels to light"};
    In<Surfels> surfels_{*this, "surfels", "points where irradiance is measured"};
    In<GBuffer> gbuffer_{*this, "gbuffer", "where the gather rays start", onlyHits_};
    In<GatherHits> hits_{*this, "gather_hits", "where the gather rays hit", onlyHits_};
    Out<VoxelIrradiance> irradiance_{*this, "irradiance", "light that arrives at the voxels' surfaces"};
    std::vector<LightSource> sources_;
    SurfelInjection injection_{*this};
    std::optional<SurfelPaths> paths_;  ///< With shadow rays or bounces.
    std::optional<HitFaces> hitFaces_;
    std::optional<ShadowMapLight> shadowMaps_;
    Buffer direct_, indirect_;  ///< Irradiance of a chunk's surfels.
};

InjectVoxelRays::InjectVoxelRays(const Params& params) : params_(params) {
    if (onlyHits_) hitFaces_.emplace(*this);
    if (params_.byShadowMaps()) shadowMaps_.emplace(*this);
}

void InjectVoxelRays::plan(PassPlan& plan) {
    const SceneState& scene = *plan.frame.scene;
    if (shadowMaps_) requireClearPanes(scene, kName);
    sources_ =
        shadowMaps_ ? requirePunctualLights(scene, kName, "'direct: shadow_rays'") : requireLightSources(scene, kName);
    plan[irradiance_].lightBounces = params_.bounces;
    injection_.plan(plan, kName, params_, plan[voxels_]);
    if (shadowMaps_) shadowMaps_->plan(plan, params_.shadowResolution);
    if (hitFaces_) hitFaces_->plan(plan);

    const bool hasBounces = params_.bounces > 0;
    constexpr uint64_t kBytes = uint64_t(Surfels::kMaxChunkSurfels) * 4 * sizeof(float);
    if (!shadowMaps_) plan.buffer(direct_, "surfels' direct irradiance", kBytes);
    if (hasBounces) plan.buffer(indirect_, "surfels' indirect irradiance", kBytes);
    if (shadowMaps_ && !hasBounces) return;
    paths_.emplace(*this);
    paths_->plan(plan, Surfels::kMaxChunkSurfels, params_.lightSamples, hasBounces);
}

void InjectVoxelRays::record(PassContext& context) {
    // Emissive surfaces may grow
    const std::vector<LightSource> sources = shadowMaps_ ? sources_ : lightSources(*context.frame.scene);
    const PathScene scene{context[voxels_], sources};
    const Surfels& surfels = context[surfels_];
    VoxelIrradiance& irradiance = context[irradiance_];
    injection_.begin(context, scene, irradiance);
    std::vector<Buffer> shadowMapLight;  // By chunk; read until finish().
    if (shadowMaps_) shadowMapLight = shadowMaps_->measure(context, sources_, surfels);
    if (hitFaces_) hitFaces_->mark(context, scene.voxels, surfels, context[gbuffer_], context[hits_]);
    for (size_t c = 0; c < surfels.chunks.size(); ++c) {
        const Surfels::Chunk& chunk = surfels.chunks[c];
        const Buffer& lit = hitFaces_ ? hitFaces_->selected() : chunk.surfels;
        const uint32_t count = hitFaces_ ? hitFaces_->select(context, chunk) : chunk.count;
        if (count == 0) continue;
        if (!shadowMaps_) {
            const uint32_t seed = randomSeed(context.frame, context.frameIndex);
            paths_->measureDirect(context, scene, lit, count, seed, direct_);
        }
        inject(context, scene, lit, count, shadowMaps_ ? shadowMapLight[c] : direct_);
    }
    injection_.finish(context, scene.voxels, irradiance);
    if (hitFaces_) return;  // Gather rays read no faces without surfels, and all that they read may be dark.
    requireLight(context.stream, scene.voxels, irradiance, *context.frame.scene);
    injection_.fillUnknown(context, scene.voxels, irradiance);
}

void InjectVoxelRays::inject(PassContext& context, const PathScene& scene, const Buffer& surfels, uint32_t count,
                             const Buffer& direct) {
    const uint32_t seed = randomSeed(context.frame, context.frameIndex);
    injection_.writeDirect(context, surfels, count, direct);
    for (uint32_t path = 0; path < params_.pathsPerPoint && params_.bounces > 0; ++path) {
        paths_->init(context, surfels, count, seed + (path + 1) * 0xc2b2ae35u, indirect_);
        for (uint32_t bounce = 0; bounce < params_.bounces; ++bounce) paths_->extend(context, scene, indirect_);
        injection_.writeIndirect(context, surfels, count, indirect_);
    }
}

VOXRAY_REGISTER_PASS(InjectVoxelRays);

}  // namespace voxray
