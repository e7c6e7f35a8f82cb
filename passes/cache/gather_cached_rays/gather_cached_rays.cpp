#include "graph/registry.h"
#include "passes/cache/radiance_cache.h"
#include "passes/final_gather/final_gather.h"

namespace voxray {

/// Indirect light by a final gather over a radiance cache: rays find what each pixel sees, hashed cells tell
/// how bright that is. Source: NVIDIA's SHaRC (its query); filter_irradiance lowers its noise.
class GatherCachedRays final : public Pass {
 public:
    static constexpr const char* kName = "gather_cached_rays";
    static constexpr const char* kHelp =
        "Gathers indirect light by shading ray hits from the radiance cache. The hits of trace_gather_rays "
        "take the irradiance of the cache there and their own albedo. A ray whose cell is missing or too "
        "near goes on as a path does. Biased by: the size of cells (update_radiance_cache); a ray that goes "
        "on brings a bounce more than the cache has. Noisy by: rays_per_block, which filter_irradiance "
        "lowers, and few samples in a cell. Lambert surfaces only.";
    struct Params {
        float nearFieldCells = 2;
        uint32_t minSamples = 1;
        uint32_t lightSamples = 1;
        static constexpr auto schema() {
            return std::tuple{
                field("near_field_cells", &Params::nearFieldCells,
                      "A ray shorter than this many edges of the cell that it hits goes on as a path does "
                      "instead of reading it.",
                      0.0625f, 64.0f),
                field("min_samples", &Params::minSamples,
                      "A cell with fewer samples is taken for missing: a ray that hits there goes on.", 1u,
                      65536u),
                field("light_samples", &Params::lightSamples,
                      "Shadow rays to the emissive surfaces, and to the environment, from each hit where a "
                      "ray goes on.",
                      1u, 256u)};
        }
    };

    explicit GatherCachedRays(const Params& params) : params_(params) {}

    void plan(PassPlan& plan) override {
        FinalGather::Settings settings{kName, {{"minSamples", params_.minSamples}}};
        settings.lightSamples = params_.lightSamples;
        settings.nearFieldCells = params_.nearFieldCells;
        settings.maxSteps = kMaxSegments;
        settings.unlit = "hits without a cell, % of rays";
        settings.storedBounces = plan[cache_].lightBounces;
        gather_.plan(plan, settings);
    }
    void record(PassContext& context) override { gather_.record(context, context[cache_].bindings()); }

 private:
    /// In a cache without a cell rays become paths of eight bounces.
    static constexpr uint32_t kMaxSegments = 7;

    const Params params_;
    In<RadianceCache> cache_{*this, "radiance_cache", "light that arrives at surfaces, by hashed cells"};
    FinalGather gather_{*this};
};
VOXRAY_REGISTER_PASS(GatherCachedRays);

}  // namespace voxray
