#pragma once

#include "passes/common/surfels/surface_points.h"
#include "passes/common/surfels/surfels.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {

/// Which sides of surfaces have points.
enum class SurfelSides { Open, All };

template <>
struct EnumNames<SurfelSides> {
    static constexpr std::array names{std::pair{SurfelSides::Open, "open"},
                                      std::pair{SurfelSides::All, "all"}};
};

/// Spreads points evenly over all surfaces and keeps those sides that have open space before them, as far as
/// a voxel: a voxel's irradiance is that of its open sides. `sides: all` keeps covered sides, too, with area
/// 0: they belong to no voxel's irradiance, but light that gets into a gap narrower than a voxel is theirs.
/// Where voxelize probes no exposure, all sides count as open. Where surfaces move, those that stay keep
/// their points, and what moves has as many for its area.
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
        SurfelSides sides = SurfelSides::Open;
        static constexpr auto schema() {
            return std::tuple{
                field(
                    "points_per_voxel", &Params::pointsPerVoxel,
                    "Points for each surface voxel, on average; where surfaces move, for each of those that "
                    "what stays passes through.",
                    1u, 256u)
                    .lessNoise(),
                field("sides", &Params::sides,
                      "open: sides with open space before them, as far as a voxel. all: covered "
                      "ones, too, which gather_surfels and links read: inside of gaps narrower "
                      "than a voxel; voxels are lit by open ones alone.")};
        }
    };

    explicit PlaceSurfels(const Params& params) : params_(params) {}
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    /// The same at all times, where anything stays.
    PointDensity density(const SurfaceVoxels& voxels, const SurfaceAreas& area) const;

    Params params_;
    Port<const SurfaceVoxels> voxels_;
    Port<Surfels> surfels_;
    Program place_, keep_;
    Buffer triangles_, rays_, occluded_, candidates_, kept_, count_;  ///< Scratch, of a batch of points.
};

}  // namespace voxray
