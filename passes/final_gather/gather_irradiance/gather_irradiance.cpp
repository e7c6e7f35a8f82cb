#include "graph/registry.h"
#include "passes/common/voxels/voxel_lookup.h"

namespace voxray {

/// Indirect light per pixel from the voxels at the surface: albedo / pi times the irradiance that the voxels
/// hold there. Source: Magalhães 2020, section 3.4.
class GatherIrradiance final : public VoxelLookupPass {
 public:
    static constexpr const char* kName = "gather_irradiance";
    static constexpr const char* kHelp =
        "Looks indirect light up in the voxels' irradiance at each pixel. The irradiance is interpolated at "
        "the pixel's surface, for the surface's normal. Biased by: voxel size (detail below it is lost, "
        "light creeps round thin edges). Lambert surfaces only. Source: Magalhães 2020, section 3.4.";

    explicit GatherIrradiance(const Params& params)
        : VoxelLookupPass(params, "indirect", "radiance reflected of indirect light",
                          &VoxelIrradiance::indirect) {}
};
VOXRAY_REGISTER_PASS(GatherIrradiance);

}  // namespace voxray
