#pragma once

#include <optional>

#include "passes/common/prefix_sum.h"
#include "passes/common/voxels.h"
#include "passes/voxelize/exposure_probe.h"

namespace voxray {

/// Turns triangles into surface voxels by rasterising them along the three axes.
///
/// Each axis projects every triangle onto a grid of `samples` squared points a voxel. A fragment of a
/// triangle with unit normal n, seen along axis a, weighs |n_a| / samples²; over the three axes that sums to
/// the triangle's area in units of voxel faces (because n_x² + n_y² + n_z² = 1), so that all averages are by
/// area. Sums are integers: the result does not depend on the order of fragments. Source: Magalhães 2020,
/// section 3.2 (three passes); the area weights are ours.
class VoxelizePass final : public Pass {
 public:
    static constexpr const char* kName = "voxelize";
    static constexpr const char* kHelp =
        "Rasterises the scene along the three axes into surface voxels: albedo, opacity, normal, emission, "
        "area. "
        "Misses surfaces that fall between the sample points: those thinner than a voxel / samples in two "
        "directions. "
        "Source: Magalhães 2020, section 3.2.";
    struct Params {
        uint32_t resolution = 128;
        uint32_t samples = 2;
        uint32_t exposureRays = 8;
        static constexpr auto schema() {
            return std::tuple{
                field("resolution", &Params::resolution, "Voxels along the scene's longest side.", 1u, 1024u),
                field("samples", &Params::samples,
                      "Sample points along a voxel's edge, in each of the three projections.", 1u, 16u),
                field("exposure_rays", &Params::exposureRays,
                      "Points a surface voxel, on average, that probe both sides for open space; 0 takes all "
                      "sides for "
                      "exposed, which darkens thin closed walls.",
                      0u, 256u)};
        }
    };

    explicit VoxelizePass(const Params& params) : params_(params) {}
    Phase phase() const override { return Phase::Build; }
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    void rasterize(PassContext& context, const Program& program, const Buffer& target, float emissionScale);

    Params params_;
    Port<SurfaceVoxels> voxels_;
    Program mark_, accumulate_, resolve_;
    std::optional<PopulationPrefixSum> prefixSum_;
    ExposureProbe exposureProbe_;
    float largestEmission_ = 0;
};

}  // namespace voxray
