#pragma once

#include "passes/common/surfels/surfels.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {

/// Spreads points evenly over all surfaces and keeps those sides that have open space before them, as far as
/// a voxel: sides inside thin walls take no light and belong to no irradiance. Where voxelize probes no
/// exposure, all sides are kept.
class PlaceSurfels final : public Pass {
 public:
    static constexpr const char* kName = "place_surfels";
    static constexpr const char* kHelp =
        "Spreads points evenly over the surfaces, where inject_voxel_rays, inject_gather_hits, "
        "inject_shadow_map and inject_radiosity measure the irradiance of voxels. Depends on geometry alone. "
        "Noisy by: "
        "points_per_voxel. "
        "Misses: voxels that hold little "
        "surface may get no point.";
    struct Params {
        uint32_t pointsPerVoxel = 4;
        static constexpr auto schema() {
            return std::tuple{field("points_per_voxel", &Params::pointsPerVoxel,
                                    "Points for each surface voxel, on average.", 1u, 256u)};
        }
    };

    explicit PlaceSurfels(const Params& params) : params_(params) {}
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    Params params_;
    Port<const SurfaceVoxels> voxels_;
    Port<Surfels> surfels_;
    Program place_, keep_;
    Buffer triangles_, rays_, occluded_, candidates_, kept_, count_;  ///< Scratch, of a batch of points.
};

}  // namespace voxray
