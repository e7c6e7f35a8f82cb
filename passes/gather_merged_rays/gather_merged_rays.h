#pragma once

#include "passes/common/final_gather/final_gather.h"
#include "passes/common/irradiance_tree/irradiance_tree.h"

namespace voxray {

/// Indirect light by a final gather over merged voxels: gather_rays, with an irradiance tree in place of
/// voxels.
class GatherMergedRays final : public Pass {
 public:
    static constexpr const char* kName = "gather_merged_rays";
    static constexpr const char* kHelp =
        "Indirect light: shades the hits of trace_gather_rays with the irradiance of merge_voxels' tree "
        "there "
        "and their own albedo. "
        "Biased by: voxel size and merge_voxels' tolerance. "
        "Noisy by: rays_per_block; filter_irradiance lowers that. Lambert surfaces only.";
    struct Params {
        float nearFieldVoxels = 2;
        uint32_t lightSamples = 1;
        static constexpr auto schema() {
            return std::tuple{
                field(
                    "near_field_voxels", &Params::nearFieldVoxels,
                    "A ray shorter than this many voxels, as they were before they were merged, or one that "
                    "hits where no light was injected, goes on as a path does instead of reading the tree, "
                    "up "
                    "to three times. 0: every hit is read.",
                    0.0f, 64.0f),
                field("light_samples", &Params::lightSamples,
                      "Shadow rays to the emissive surfaces, and to the environment, from each hit where "
                      "direct light is measured.",
                      1u, 256u)};
        }
    };

    explicit GatherMergedRays(const Params& params) : params_(params) {}
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    Params params_;
    FinalGather gather_;
    Port<const IrradianceTree> tree_;
};

}  // namespace voxray
