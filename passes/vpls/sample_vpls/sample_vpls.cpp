#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <vector>

#include "base/error.h"
#include "graph/registry.h"
#include "passes/common/compute/bit_words.h"
#include "passes/common/compute/compaction.h"
#include "passes/common/compute/random_seed.h"
#include "passes/common/lights/pane_transmittance.h"
#include "passes/common/voxel_march/voxel_tracer.h"
#include "passes/inject/light_paths/light_emission.h"
#include "passes/inject/light_paths/light_path_types.h"
#include "passes/vpls/sample_vpls/rsm_sampling.h"
#include "passes/vpls/vpls.h"
#include "scene/region_split.h"

namespace voxray {
namespace {

constexpr uint32_t kBatchPaths = 1u << 20;  // Bounds the memory of rays to 84 MiB.

/// Divides `paths` among the sources by power; each gets at least one.
std::vector<uint32_t> pathCountsBySource(const std::vector<LightSource>& sources, uint32_t paths) {
    const double power = totalPower(sources);
    std::vector<uint32_t> counts;
    for (const LightSource& source : sources)
        counts.push_back(std::max(1u, uint32_t(std::lround(paths * (double(source.power) / power)))));
    return counts;
}

/// Interleaves the paths of all sources evenly: the index of each path, source by source. Any range of
/// indices then holds a range of each source's Sobol sequence.
std::vector<uint32_t> interleavedPathOrder(const std::vector<uint32_t>& pathCounts) {
    std::vector<double> position;
    for (const uint32_t paths : pathCounts)
        for (uint32_t i = 0; i < paths; ++i) position.push_back((i + 0.5) / paths);
    std::vector<uint32_t> paths(position.size()), order(position.size());
    std::iota(paths.begin(), paths.end(), 0u);
    std::stable_sort(paths.begin(), paths.end(), [&](uint32_t a, uint32_t b) { return position[a] < position[b]; });
    for (uint32_t index = 0; index < paths.size(); ++index) order[paths[index]] = index;
    return order;
}

/// The same source among those that are on now, or nullptr.
const LightSource* findSource(const std::vector<LightSource>& sources, const LightSource& source) {
    const auto it = std::ranges::find_if(sources, [&](const LightSource& candidate) {
        return candidate.kind == source.kind && candidate.light == source.light;
    });
    return it == sources.end() ? nullptr : &*it;
}

}  // namespace

/// How first path vertices are sampled.
enum class FirstVertices { LightRays, Rsm };
template <>
struct EnumNames<FirstVertices> {
    static constexpr std::array names{std::pair{FirstVertices::LightRays, "light_rays"},
                                      std::pair{FirstVertices::Rsm, "rsm"}};
};

/// What rays after the first hit are traced through.
enum class VplBounce { Exact, Svo };
template <>
struct EnumNames<VplBounce> {
    static constexpr std::array names{std::pair{VplBounce::Exact, "exact"}, std::pair{VplBounce::Svo, "svo"}};
};

/// Virtual point lights at the vertices of light paths (instant radiosity, Keller 1997). FirstVertices::Rsm
/// follows Sun and Agu 2015, sections 3 and 3.2: first vertices by importance sampling of reflective shadow
/// maps, further ones by rays.
class SampleVpls final : public Pass {
 public:
    static constexpr const char* kName = "sample_vpls";
    static constexpr const char* kHelp =
        "Deposits virtual point lights (VPLs) where light paths hit surfaces, for gather_vpls. "
        "Lights of every kind emit paths in proportion to their power. "
        "All surfaces are Lambert surfaces of their base colour. Biased by: voxel size with 'bounce: svo'. Noisy by: "
        "vpls_per_bounce. Each frame takes the same random numbers, so that virtual lights move with a light, "
        "unless 'resample' is set. Source: Keller 1997; Sun and Agu 2015, section 3.2.";
    struct Params {
        uint32_t vplsPerBounce = 1024;
        uint32_t bounces = 3;
        FirstVertices first = FirstVertices::LightRays;
        VplBounce bounce = VplBounce::Exact;
        bool resample = false;
        static constexpr auto schema() {
            return std::tuple{
                field("vpls_per_bounce", &Params::vplsPerBounce,
                      "Light paths, at least one per light. "
                      "Each deposits a virtual light at each hit, until Russian roulette by albedo ends it.",
                      1u, 1u << 24)
                    .lessNoise(),
                field("bounces", &Params::bounces, "Bounces of light: maximum hits of a path.", 1u, 16u),
                field("first", &Params::first,
                      "How first hits are sampled. light_rays: by rays of equal power from lights of every kind. "
                      "rsm: by texels of reflective shadow maps (render_rsm) in proportion to the flux "
                      "that their points reflect; point, spot and directional lights only."),
                field("bounce", &Params::bounce,
                      "What rays after the first hit are traced through. exact: triangles. "
                      "svo: surface voxels; virtual lights past the first bounce lie where rays enter them, "
                      "with the voxel's mean normal and albedo."),
                field("resample", &Params::resample,
                      "Whether each frame takes its own random numbers, for comparison: virtual lights then jump.")};
        }
    };

    explicit SampleVpls(const Params& params);
    Phase phase() const override { return params_.resample ? Phase::Frame : Phase::Build; }
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    /// Traces all paths of source `s`, the first of which has the index `firstPath` source by source. @param
    /// source the same in this frame.
    void tracePaths(PassContext& context, uint32_t s, const LightSource& source, uint32_t firstPath);

    const Params params_;
    In<Rsm> rsm_{*this, "rsm", "what lights see", params_.first == FirstVertices::Rsm};
    In<SurfaceVoxels> voxels_{*this, "voxels", "what rays of further bounces hit", params_.bounce == VplBounce::Svo};
    Out<Vpls> vpls_{*this, "vpls", "virtual point lights"};
    std::vector<LightSource> sources_;        ///< Sources that were on when paths were divided.
    std::vector<uint32_t> pathCounts_;        ///< By source.
    std::optional<LightEmission> emission_;   ///< With FirstVertices::LightRays.
    std::optional<RsmSampling> rsmSampling_;  ///< With FirstVertices::Rsm.
    std::optional<VoxelTracer> voxelTracer_;  ///< With VplBounce::Svo.
    Kernel depositVpls_{*this, "deposit_vpls.comp",
                        params_.bounce == VplBounce::Svo ? Defines{{"VOXEL_NEXT", "1"}} : Defines{}};
    Kernel depositVplsInVoxels_{*this, "deposit_vpls.comp", {{"VOXEL_HITS", "1"}, {"VOXEL_NEXT", "1"}}};
    Compaction compaction_{*this};
    Buffer rays_, hits_, paths_, pathOrder_, flags_;
    PaneTransmittance paneTransmittance_{*this};
};

SampleVpls::SampleVpls(const Params& params) : params_(params) {
    if (params_.first == FirstVertices::Rsm)
        rsmSampling_.emplace(*this);
    else
        emission_.emplace(*this);
    if (params_.bounce == VplBounce::Svo) voxelTracer_.emplace(*this, VoxelTraversal::Svo);
}

void SampleVpls::plan(PassPlan& plan) {
    sources_ = requireLightSources(*plan.frame.scene, kName);
    pathCounts_ = pathCountsBySource(sources_, params_.vplsPerBounce);
    Vpls& vpls = plan[vpls_];
    vpls.paths = std::accumulate(pathCounts_.begin(), pathCounts_.end(), 0u);
    vpls.areaPerPath = float(surfaceArea(plan.frame.scene->geometry) / vpls.paths);
    vpls.bounces = params_.bounces;
    vpls.lightBounces = params_.bounces;
    const uint64_t points = vpls.capacity(kName);
    const uint64_t batch = std::min(*std::max_element(pathCounts_.begin(), pathCounts_.end()), kBatchPaths);
    plan.buffer(vpls.points, "virtual point lights", points * sizeof(gpu::Vpl));
    plan.buffer(vpls.activeIndices, "list of virtual point lights", points * sizeof(uint32_t));
    plan.buffer(pathOrder_, "order of light paths", vpls.paths * sizeof(uint32_t));
    plan.buffer(flags_, "flags of virtual point lights", bitWords(points) * sizeof(uint32_t));
    plan.scratchBuffer(rays_, "light rays", batch * sizeof(Ray));
    plan.scratchBuffer(hits_, "light ray hits", batch * sizeof(Hit));
    plan.scratchBuffer(paths_, "light paths", batch * sizeof(gpu::LightPath));
    paneTransmittance_.plan(plan, batch);
    if (rsmSampling_)
        rsmSampling_->plan(plan, plan[rsm_]);
    else
        emission_->plan(plan, batch);
    if (voxelTracer_) voxelTracer_->plan(plan, plan[voxels_]);
    depositVplsInVoxels_.compileIf(voxelTracer_.has_value());
}

void SampleVpls::prepare(PassSetup& setup) {
    setup.stream.upload(pathOrder_, interleavedPathOrder(pathCounts_));
}

void SampleVpls::record(PassContext& context) {
    CommandStream& stream = context.stream;
    Vpls& vpls = context[vpls_];
    const std::vector<LightSource> activeSources = lightSources(*context.frame.scene);
    for (const LightSource& source : activeSources)
        if (!findSource(sources_, source))
            throw Error("{}: a light began to shine after the first frame, when paths were divided among lights",
                        kName);
    stream.fill(flags_, 0);
    stream.fill(vpls.points, 0);
    if (voxelTracer_) voxelTracer_->begin(stream, context[voxels_]);
    const uint64_t voxelRaysBefore = voxelTracer_ ? voxelTracer_->raysTraced() : 0;
    uint32_t firstPath = 0;
    for (uint32_t s = 0; s < sources_.size(); firstPath += pathCounts_[s], ++s)
        if (const LightSource* source = findSource(activeSources, sources_[s]))
            tracePaths(context, s, *source, firstPath);
    if (voxelTracer_) {
        context.extraRays += voxelTracer_->raysTraced() - voxelRaysBefore;
        context.marchCounters.push_back(&voxelTracer_->march().counts());
    }
    vpls.activeCount = compaction_.run(stream, flags_, vpls.activeIndices, uint32_t(flags_.bytes() / sizeof(uint32_t)));
    context.report("vpls", vpls.activeCount);
    if (vpls.activeCount == 0 && !activeSources.empty())
        throw Error(
            "{}: none of {} rays from the lights hit a surface that reflects light; "
            "let lights shine on the scene, or raise 'vpls_per_bounce'",
            kName, vpls.paths);
}

void SampleVpls::tracePaths(PassContext& context, uint32_t s, const LightSource& source, uint32_t firstPath) {
    CommandStream& stream = context.stream;
    std::vector<Binding> voxelBindings{{"grid", gpu::VoxelGrid{}}};
    if (voxelTracer_) voxelBindings = context[voxels_].bindings();
    const auto seedIndex = uint32_t(s + (params_.resample ? context.frameIndex * sources_.size() : 0));
    LightEmission::Batch batch{randomSeed(context.frame, seedIndex), pathCounts_[s], 0, 0};
    for (; batch.first < batch.rays; batch.first += batch.count) {
        batch.count = std::min(batch.rays - batch.first, kBatchPaths);
        if (rsmSampling_)
            rsmSampling_->emit(context, context[rsm_], s, {rays_, hits_, paths_, batch});
        else
            emission_->emit(context, source, batch, rays_, paths_);
        for (uint32_t bounce = 0; bounce < params_.bounces; ++bounce) {
            const bool tracesVoxels = voxelTracer_ && bounce > 0;
            if (tracesVoxels)
                voxelTracer_->closestHit(stream, rays_, hits_, batch.count);
            else if (bounce > 0 || !rsmSampling_)
                context.tracer.closestHit(stream, rays_, hits_, batch.count);
            if (bounce == 0)
                paneTransmittance_.apply(context, rays_, paths_, sizeof(gpu::LightPath) / sizeof(float), batch.count,
                                         &hits_);
            context.dispatch(tracesVoxels ? depositVplsInVoxels_ : depositVpls_, batch.count,
                             {context.scene,
                              voxelBindings,
                              {"rays", rays_},
                              {"hits", hits_},
                              {"paths", paths_},
                              {"pathOrder", pathOrder_},
                              {"VplsRef", context[vpls_].points.ref()},
                              {"flags", flags_},
                              {"count", batch.count},
                              {"firstPath", firstPath + batch.first},
                              {"firstRay", batch.first},
                              {"seed", batch.seed},
                              {"bounce", bounce},
                              {"bounces", params_.bounces}});
        }
    }
}

VOXRAY_REGISTER_PASS(SampleVpls);

}  // namespace voxray
