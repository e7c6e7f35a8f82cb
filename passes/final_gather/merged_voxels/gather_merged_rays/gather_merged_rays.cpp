#include "graph/registry.h"
#include "passes/final_gather/final_gather.h"
#include "passes/final_gather/merged_voxels/irradiance_tree.h"

namespace voxray {

/// Indirect light by a final gather over merged voxels: gather_rays, with an irradiance tree in place of
/// voxels.
class GatherMergedRays final : public Pass {
 public:
    static constexpr const char* kName = "gather_merged_rays";
    static constexpr const char* kHelp =
        "Gathers indirect light by shading ray hits with merged voxels' light. The hits of trace_gather_rays "
        "take the irradiance of merge_voxels' tree there and their own albedo. Biased by: voxel size and "
        "merge_voxels' tolerance. Noisy by: rays_per_block; filter_irradiance lowers that. Lambert surfaces "
        "only.";
    struct Params {
        float nearFieldVoxels = 2;
        uint32_t lightSamples = 1;
        static constexpr auto schema() {
            return std::tuple{
                field("near_field_voxels", &Params::nearFieldVoxels,
                      "A ray shorter than this many voxels, as they were before they were merged, or one "
                      "that hits where no light was injected, goes on as a path does instead of reading the "
                      "tree, up to three times. 0: every hit is read.",
                      0.0f, 64.0f),
                field("light_samples", &Params::lightSamples,
                      "Shadow rays to the emissive surfaces, and to the environment, from each hit where "
                      "direct light is measured.",
                      1u, 256u)};
        }
    };

    explicit GatherMergedRays(const Params& params) : params_(params) {}

    void plan(PassPlan& plan) override {
        FinalGather::Settings settings{kName};
        settings.shadowRays = !plan[tree_].holdsDirect;
        settings.lightSamples = params_.lightSamples;
        settings.nearFieldCells = params_.nearFieldVoxels;
        settings.storedBounces = plan[tree_].lightBounces;
        gather_.plan(plan, settings);
    }
    void record(PassContext& context) override { gather_.record(context, context[tree_].bindings()); }

 private:
    const Params params_;
    In<IrradianceTree> tree_{*this, "irradiance_tree", "light of merged voxels"};
    FinalGather gather_{*this};
};
VOXRAY_REGISTER_PASS(GatherMergedRays);

}  // namespace voxray
