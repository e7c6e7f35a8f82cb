#pragma once

#include <array>
#include <optional>
#include <utility>

#include "graph/registry.h"
#include "passes/common/irradiance_tree/irradiance_tree.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {

/// Which light merged voxels hold.
enum class MergedLight { All, Indirect };
template <>
struct EnumNames<MergedLight> {
    static constexpr std::array names{std::pair{MergedLight::All, "all"},
                                      std::pair{MergedLight::Indirect, "indirect"}};
};

/// Merges voxels that hold nearly the same light, so that error decides where they are small.
class MergeVoxels final : public Pass {
 public:
    static constexpr const char* kName = "merge_voxels";
    static constexpr const char* kHelp =
        "Merges neighbouring voxels that hold nearly the same light into the leaves of a k-d tree for each "
        "face, for gather_merged_rays. The tree is grown down to voxels and pruned where leaves are not "
        "worth "
        "their memory. Runs on the host. "
        "Biased by: tolerance; flux is kept. "
        "Source: cost-complexity pruning (Breiman et al. 1984; Chou, Lookabaugh and Gray 1989).";
    struct Params {
        float tolerance = 0.3f;
        MergedLight light = MergedLight::All;
        static constexpr auto schema() {
            return std::tuple{
                field("tolerance", &Params::tolerance,
                      "Relative error of irradiance that is allowed over one voxel's face: a leaf is kept "
                      "where it lowers the squared relative error, times area, by more than this squared "
                      "voxel faces. 0: voxels are merged only where they hold the same. Black is merged with "
                      "black alone.",
                      0.0f, 30.0f),
                field("light", &Params::light,
                      "all: direct and indirect light. indirect: gather_merged_rays measures direct light at "
                      "each hit.")};
        }
    };

    explicit MergeVoxels(const Params& params) : params_(params) {}
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup&) override { version_.reset(); }
    void record(PassContext& context) override;

 private:
    Params params_;
    Port<const SurfaceVoxels> voxels_;
    Port<const VoxelIrradiance> irradiance_;
    Port<IrradianceTree> tree_;
    std::optional<std::pair<uint64_t, uint64_t>> version_;  ///< Of the voxels and the light in them.
};

}  // namespace voxray
