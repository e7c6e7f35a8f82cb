#pragma once

#include "passes/common/voxel_builder/voxel_builder.h"

namespace voxray {

enum class VoxelizeMethodName { Exact, DominantAxis, ThreeAxis };
template <>
struct EnumNames<VoxelizeMethodName> {
    static constexpr std::array names{std::pair{VoxelizeMethodName::Exact, "exact"},
                                      std::pair{VoxelizeMethodName::DominantAxis, "dominant_axis"},
                                      std::pair{VoxelizeMethodName::ThreeAxis, "three_axis"}};
};

/// Turns triangles into surface voxels: everywhere the first time, later where surfaces have changed.
class VoxelizePass final : public Pass {
 public:
    static constexpr const char* kName = "voxelize";
    static constexpr const char* kHelp =
        "Turns the scene into surface voxels: albedo, normal, emission, metallic, roughness, opacity, area. "
        "method exact tests triangles against voxels' boxes; dominant_axis rasterises once and "
        "conservatively: "
        "it adds voxels that are only grazed, and samples areas; three_axis rasterises three times and "
        "misses surfaces between its sample points: those thinner than a voxel / samples_per_voxel_edge in "
        "two directions. "
        "Source: Magalhães 2020, section 3.2; Schwarz and Seidel 2010 (exact).";
    struct Params : VoxelBuildParams {
        VoxelizeMethodName method = VoxelizeMethodName::Exact;
        uint32_t resolution = 128;
        uint32_t samplesPerVoxelEdge = 2;
        static constexpr auto schema() {
            return std::tuple_cat(
                std::tuple{
                    field("method", &Params::method,
                          "How the voxels that triangles meet are found: exact (compute shader, overlap of "
                          "triangles and boxes), "
                          "dominant_axis (one conservative raster pass), three_axis (three raster passes)."),
                    field("resolution", &Params::resolution, "Voxels along the scene's longest side.", 1u,
                          1024u),
                    field("samples_per_voxel_edge", &Params::samplesPerVoxelEdge,
                          "Sample points along a voxel's edge, in each of the three projections.", 1u, 16u)
                        .onlyWith(oneOf(&Params::method, {VoxelizeMethodName::ThreeAxis}))},
                VoxelBuildParams::schema());
        }
    };

    explicit VoxelizePass(const Params& params);
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    Params params_;
    Port<SurfaceVoxels> voxels_;
    VoxelBuilder builder_;
};

}  // namespace voxray
