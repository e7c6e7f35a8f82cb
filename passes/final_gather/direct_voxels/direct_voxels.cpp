#include "graph/registry.h"
#include "passes/common/voxels/voxel_lookup.h"

namespace voxray {

/// Direct light per pixel from the voxels at the surface, as the thesis has it: no shadow ray per pixel,
/// shadows no finer than a voxel. Source: Magalhães 2020, section 3.4.
class DirectVoxels final : public VoxelLookupPass {
 public:
    static constexpr const char* kName = "direct_voxels";
    static constexpr const char* kHelp =
        "Looks direct light up in the voxels instead of tracing shadow rays. It takes no ray per pixel, but "
        "shadows and highlights are no finer than a voxel. Biased by: voxel size. Noisy by: the injection's "
        "rays. Lambert surfaces only. Compare with direct_shadow_rays. Source: Magalhães 2020, section 3.4.";

    explicit DirectVoxels(const Params& params)
        : VoxelLookupPass(params, "direct", "radiance reflected of direct light", &VoxelIrradiance::direct) {}
};
VOXRAY_REGISTER_PASS(DirectVoxels);

}  // namespace voxray
