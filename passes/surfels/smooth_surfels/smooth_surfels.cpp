#include <algorithm>

#include "graph/registry.h"
#include "passes/surfels/surfel_neighbors.h"
#include "passes/surfels/surfels_by_voxel.h"

namespace voxray {
namespace {

constexpr uint64_t kNeighborhoodBytes = 4 * sizeof(float), kLitBytes = 2 * sizeof(uint64_t),
                   kNodeBytes = 2 * sizeof(uint32_t);

}  // namespace

/// Denoises the irradiance of surfels by means over neighbors in the same light. Source: the weights of
/// filter_irradiance (docs/filtering.md), between points in space; docs/surfels.md.
class SmoothSurfels final : public Pass {
 public:
    static constexpr const char* kName = "smooth_surfels";
    static constexpr const char* kHelp =
        "Denoises the surfels' irradiance by means over neighbors. "
        "Each surfel takes the mean over the surfels within a voxel's size, "
        "as far as they are on the same surface in the same light. "
        "Runs once for a light, so that gather_surfels is less noisy at the same cost per frame. "
        "Biased by: iterations (blurs what is smaller than a voxel).";
    struct Params {
        uint32_t iterations = 2;
        static constexpr auto schema() {
            return std::tuple{field("iterations", &Params::iterations,
                                    "Number of times that each surfel takes the mean over its neighbors.", 1u, 16u)};
        }
    };

    explicit SmoothSurfels(const Params& params) : params_(params) {}
    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    const Params params_;
    In<SurfelsByVoxel> surfels_{*this, "surfels_by_voxel", "the surfels of each voxel"};
    In<SurfelNeighbors> neighbors_{*this, "neighbors", "the surfels around each surfel"};
    In<SurfelIrradiance> light_{*this, "surfel_irradiance", "light that arrives at surfels"};
    Out<SurfelIrradiance> smooth_{*this, "surfel_irradiance", "the same with less noise"};
    Kernel loadNodes_{*this, "load_nodes.comp"};
    Kernel moments_{*this, "neighborhood_moments.comp"};
    Kernel mean_{*this, "mean.comp"};
    Kernel storeNodes_{*this, "store_nodes.comp"};
};

void SmoothSurfels::plan(PassPlan& plan) {
    plan[smooth_].relativeVariance = plan[light_].relativeVariance;
    if (!plan[neighbors_].areBySurfel) return;
    for (Kernel* kernel : {&loadNodes_, &storeNodes_}) kernel->define({{"BY_SURFEL", "1"}});
}

void SmoothSurfels::record(PassContext& context) {
    const SurfelsByVoxel& surfels = context[surfels_];
    const SurfelNeighbors& neighbors = context[neighbors_];
    const uint32_t count = neighbors.nodeCount;
    const uint64_t allocated = std::max(count, 1u);
    ensureSize(context[smooth_].lit, context.device, "smooth irradiance of surfels",
               std::max(surfels.sortedCount, 1u) * kLitBytes);
    const LargeBuffer nodes(context.device, "irradiance of surfels, smoothed in place", allocated * kNodeBytes);
    const LargeBuffer neighborhoods(context.device, "moments of neighborhoods", allocated * kNeighborhoodBytes);

    const Bindings surfelBindings{
        ifUsed({"SortedIndicesRef", surfels.sortedIndices.ref()}),
        {"LitRef", context[light_].lit.ref()},
        {"NodesRef", nodes.ref()},
        {"count", count},
    };
    context.dispatch(loadNodes_, count, surfelBindings);
    const Bindings bindings{{"ranges", neighbors.ranges},
                            {"PairsRef", neighbors.pairs.ref()},
                            {"NodesRef", nodes.ref()},
                            {"NeighborhoodsRef", neighborhoods.ref()},
                            {"count", count},
                            {"noise", context[light_].relativeVariance},
                            {"squaredRadius", neighbors.radius * neighbors.radius}};
    for (uint32_t i = 0; i < params_.iterations; ++i) {
        context.dispatch(moments_, count, bindings);
        context.dispatch(mean_, count, bindings);
    }
    context.dispatch(storeNodes_, count, {surfelBindings.all(), {"ResultRef", context[smooth_].lit.ref()}});
    context.stream.finish();
}

VOXRAY_REGISTER_PASS(SmoothSurfels);

}  // namespace voxray
