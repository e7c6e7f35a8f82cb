#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "graph/registry.h"
#include "passes/clusters/cluster_light.h"
#include "passes/clusters/gather_clusters/visible_voxels.h"
#include "passes/clusters/voxel_clusters.h"

namespace voxray {

/// The patches that the filter averages: all, or those that receive light.
enum class FilterOver { All, Lit };
template <>
struct EnumNames<FilterOver> {
    static constexpr std::array names{std::pair{FilterOver::All, "all"}, std::pair{FilterOver::Lit, "lit"}};
};

/// Gathers indirect irradiance along the visibility lists of patches, filters it over neighbors and averages
/// it for the faces of voxels. Source: Cosin and Patow 2022, section 4.4.
class GatherClusters final : public Pass {
 public:
    static constexpr const char* kName = "gather_clusters";
    static constexpr const char* kHelp =
        "Gathers each patch's irradiance from the voxel clusters that it sees. It sums the light "
        "of inject_clusters over the lists of cluster_visibility and filters it over neighbors that see each other. "
        "The result is irradiance of voxels, with the direct light of inject_clusters, "
        "for gather_irradiance or gather_rays. Biased by: voxel and cluster size, "
        "the filter (light leaks round edges). Noisy by: the lists' rays. Source: Cosin and Patow 2022, section 4.4.";
    struct Params {
        GatherUpdate update = GatherUpdate::All;
        uint32_t reach = 4;
        uint32_t filterPasses = 1;
        uint32_t filterSize = 3;
        FilterOver filterOver = FilterOver::All;
        static constexpr auto schema() {
            return std::tuple{
                field("update", &Params::update,
                      "Voxels whose light is gathered. all: every voxel, whenever light or voxels have changed. "
                      "seen: voxels around what the camera sees, "
                      "once when they come into view and again when light or voxels change; "
                      "for gather_irradiance, which reads no others. "
                      "seen_points: likewise, but voxels of which the camera sees one of 12 points, "
                      "2 voxels from their centers (the paper's test); lookups exclude other voxels."),
                field("reach", &Params::reach,
                      "Distance in voxels along each axis of voxels that count as around what the camera sees. "
                      "It must cover the lookup that follows: "
                      "4 times gather_irradiance's 'radius' where there are few surfaces, and one more with 'lookup: "
                      "seven_tap'. A lookup that reads farther is refused.",
                      1u, 64u)
                    .onlyWith(oneOf(&Params::update, {GatherUpdate::Seen})),
                field("filter_passes", &Params::filterPasses,
                      "How often patches are averaged with those at the same faces of neighboring surface groups. "
                      "The paper: 2, of size 5.",
                      0u, 8u),
                field("filter_size", &Params::filterSize,
                      "Voxels along each edge of the filter's cube, with binomial weights (about a Gaussian). "
                      "Occluded neighbors and faces without surfaces are excluded.",
                      std::vector{3u, 5u})
                    .onlyWith(noneOf(&Params::filterPasses, {0u})),
                field("filter_over", &Params::filterOver,
                      "Faces that are averaged. all: every face in the cube. "
                      "lit: those that receive light (the paper's); "
                      "light then spreads to unlit faces without a loss elsewhere, so its total grows.")
                    .onlyWith(noneOf(&Params::filterPasses, {0u}))};
        }
    };

    explicit GatherClusters(const Params& params) : params_(params) {
        if (isLazy()) visible_.emplace(*this, params_.update);
    }
    Phase phase() const override { return isLazy() ? Phase::Frame : Phase::Build; }
    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    bool isLazy() const { return params_.update != GatherUpdate::All; }
    bool readsGBuffer() const { return params_.update == GatherUpdate::Seen; }
    /// Iterations of a filter of 3 voxels: a binomial filter of 5 voxels is one of 3, applied twice.
    uint32_t filterSteps() const { return params_.filterPasses * (params_.filterSize / 2); }
    Defines defines() const;
    /// Gathers, filters and stores the irradiance of `voxels`.
    void gather(PassContext& context, const VisibleVoxels::NewVoxels& voxels);

    const Params params_;
    In<SurfaceVoxels> voxels_{*this, "voxels", "surface voxels"};
    In<VoxelPatches> patches_{*this, "patches", "surface groups and patches of voxels"};
    In<VoxelClusters> clusters_{*this, "clusters", "clusters of surface voxels"};
    In<ClusterVisibility> visibility_{*this, "cluster_visibility", "visibility lists of patches"};
    In<ClusterLight> light_{*this, "cluster_light", "radiosity of cluster components and patches"};
    In<GBuffer> gbuffer_{*this, "gbuffer", "what the camera sees", readsGBuffer()};
    Out<VoxelIrradiance> irradiance_{*this, "irradiance", "direct light and gathered indirect light"};
    std::optional<VisibleVoxels> visible_;  ///< If isLazy().
    Kernel gatherGroups_{*this, "gather_groups.comp", defines()};
    Kernel filterIrradiance_{*this, "filter_irradiance.comp", defines()};
    Kernel storeIrradiance_{*this, "store_irradiance.comp", defines()};
    LargeBuffer gathered_, filtered_;  ///< Irradiance of patches.
};

Defines GatherClusters::defines() const {
    Defines defines = isLazy() ? Defines{{"LISTED", "1"}} : Defines{};
    if (params_.filterOver == FilterOver::Lit) defines.emplace("LIT_ONLY", "1");
    return defines;
}

void GatherClusters::plan(PassPlan& plan) {
    plan[irradiance_].lightBounces = oneMoreBounce(plan[light_].lightBounces);
    if (readsGBuffer()) plan[irradiance_].reach = params_.reach;
    plan.estimate(plan[voxels_].estimatedCount * VoxelIrradiance::bytes(1));
    if (visible_) visible_->plan(plan);
}

void GatherClusters::record(PassContext& context) {
    const SurfaceVoxels& voxels = context[voxels_];
    const VoxelPatches& patches = context[patches_];
    const bool isNew = context.changed(visibility_) || context.changed(light_);
    VoxelIrradiance& result = context[irradiance_];
    if (isNew) result.allocate(context.device, voxels.voxelCount);
    if (!isLazy()) {
        if (!isNew) return context.markOutputsUnchanged();
        VisibleVoxels::NewVoxels all;
        all.voxelCount = voxels.voxelCount;
        all.groupCounts.assign(filterSteps() + 1, patches.groupCount);
        gather(context, all);
        requireLight(context.stream, voxels, result, *context.frame.scene);
        return;
    }
    if (isNew) {
        for (const Buffer* buffer : result.checkedBuffers()) context.stream.fill(*buffer, 0);
        visible_->reset(context, voxels, patches);
    }
    const GBuffer* gbuffer = readsGBuffer() ? &context[gbuffer_] : nullptr;
    const VisibleVoxels::NewVoxels newVoxels =
        visible_->find(context, gbuffer, voxels, context[clusters_], patches, params_.reach, filterSteps());
    context.report("voxels gathered", newVoxels.voxelCount);
    if (newVoxels.voxelCount > 0)
        gather(context, newVoxels);
    else if (!isNew)
        context.markOutputsUnchanged();
}

void GatherClusters::gather(PassContext& context, const VisibleVoxels::NewVoxels& voxels) {
    const float voxelSize = context[voxels_].grid.voxelSize;
    const VoxelPatches& patches = context[patches_];
    const ClusterVisibility& visibility = context[visibility_];
    const ClusterLight& light = context[light_];
    CommandStream& stream = context.stream;
    std::vector<Binding> listedGroups, newVoxels;
    if (visible_) {
        listedGroups.emplace_back("listedGroups", visible_->groups());
        newVoxels.emplace_back("newVoxels", visible_->voxels());
    }
    const uint64_t bytes = std::max(patches.patchCount, 1u) * sizeof(glm::vec3);
    ensureSize(gathered_, context.device, "irradiance of patches", bytes);
    ensureSize(filtered_, context.device, "filtered irradiance", bytes);
    const uint32_t steps = filterSteps(), groups = voxels.groupCounts[steps];
    context.dispatch(gatherGroups_, groups,
                     {gatherBindings(visibility, light),
                      listedGroups,
                      {"groups", patches.groups},
                      {"GatheredRef", gathered_.ref()},
                      {"lists", visibility.layout},
                      {"count", groups}});
    for (uint32_t i = 0; i < steps; ++i) {
        const uint32_t count = voxels.groupCounts[steps - 1 - i];
        context.dispatch(filterIrradiance_, count,
                         {listedGroups,
                          context[voxels_],
                          {"groups", patches.groups},
                          {"firstGroup", patches.firstGroup},
                          {"coordinates", context[clusters_].coordinates},
                          {"firstNeighbor", patches.firstNeighbor},
                          {"NeighborsRef", patches.neighbors.ref()},
                          {"GatheredRef", gathered_.ref()},
                          {"FilteredRef", filtered_.ref()},
                          {"count", count}});
        stream.finish();
        std::swap(gathered_, filtered_);
    }
    const VoxelIrradiance& result = context[irradiance_];
    const uint32_t pairs = 3 * voxels.voxelCount;
    context.dispatch(storeIrradiance_, pairs,
                     {newVoxels,
                      {"groups", patches.groups},
                      {"firstGroup", patches.firstGroup},
                      {"GroupMaterialsRef", patches.materials.ref()},
                      {"GatheredRef", gathered_.ref()},
                      {"PatchDirectRef", light.direct.ref()},
                      {"DirectRef", result.direct.ref()},
                      {"IndirectRef", result.indirect.ref()},
                      {"area", result.area},
                      {"pairs", pairs},
                      {"voxelFaceArea", voxelSize * voxelSize}});
    stream.finish();
    if (isLazy()) return;  // The buffers are reused for voxels that come into view later.
    gathered_ = {};
    filtered_ = {};
}

VOXRAY_REGISTER_PASS(GatherClusters);

}  // namespace voxray
