#include "base/error.h"
#include "graph/registry.h"
#include "passes/common/voxel_builder/voxel_builder.h"

namespace voxray {

enum class VoxelizeMethod { Exact, DominantAxis, HardwareConservative, Multisampled, ThreeAxis };
template <>
struct EnumNames<VoxelizeMethod> {
    static constexpr std::array names{
        std::pair{VoxelizeMethod::Exact, "exact"}, std::pair{VoxelizeMethod::DominantAxis, "dominant_axis"},
        std::pair{VoxelizeMethod::HardwareConservative, "hardware_conservative"},
        std::pair{VoxelizeMethod::Multisampled, "msaa"}, std::pair{VoxelizeMethod::ThreeAxis, "three_axis"}};
};

/// Voxelizes triangles into surface voxels: the whole scene first, then the regions where surfaces change.
class VoxelizePass final : public Pass {
 public:
    static constexpr const char* kName = "voxelize";
    static constexpr bool kDependsOnLight = false;
    static constexpr const char* kHelp =
        "Voxelizes the scene's triangles into surface voxels with materials. A voxel holds albedo, normal, emission, "
        "metallic, roughness, opacity and area. method exact tests triangles against voxel boxes; "
        "dominant_axis rasterizes once and conservatively, which adds voxels that are only grazed and samples areas; "
        "hardware_conservative does so by the device; "
        "msaa rasterizes once, multisampled, and misses surfaces between samples; "
        "three_axis rasterizes three times and misses surfaces between sample points, "
        "those thinner than a voxel / samples_per_voxel_edge in two directions. "
        "Source: Magalhães 2020, section 3.2; Schwarz and Seidel 2010 (exact).";
    struct Params : VoxelBuildParams {
        VoxelizeMethod method = VoxelizeMethod::Exact;
        uint32_t resolution = 128;
        uint32_t samplesPerVoxelEdge = 2;
        uint32_t msaaSamples = 4;
        static constexpr auto schema() {
            return std::tuple_cat(
                std::tuple{
                    field("method", &Params::method,
                          "Test for the voxels that triangles overlap: "
                          "exact (compute shader, overlap of triangles and boxes), "
                          "dominant_axis (one conservative raster pass, by shaders), "
                          "hardware_conservative (the same by VK_EXT_conservative_rasterization), "
                          "msaa (one multisampled raster pass), three_axis (three raster passes)."),
                    field("resolution", &Params::resolution, "Voxels along the scene's longest side.", 1u, 1024u),
                    field("samples_per_voxel_edge", &Params::samplesPerVoxelEdge,
                          "Sample points along a voxel's edge, in each of the three projections.", 1u, 16u)
                        .onlyWith(oneOf(&Params::method, {VoxelizeMethod::ThreeAxis})),
                    field("msaa_samples", &Params::msaaSamples,
                          "Samples a pixel, a voxel wide, at the device's standard places.", powersOfTwo(1, 64))
                        .onlyWith(oneOf(&Params::method, {VoxelizeMethod::Multisampled}))},
                VoxelBuildParams::schema());
        }
    };

    explicit VoxelizePass(const Params& params) : params_(params) {}
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override {
        const SurfaceVoxels& v = setup[voxels_];
        setup.stream.upload(v.levels, std::vector{wholeLevel(v.grid)});
    }
    void record(PassContext& context) override;

 private:
    std::unique_ptr<TriangleVoxelizer> makeVoxelizer();

    const Params params_;
    Out<SurfaceVoxels> voxels_{*this, "voxels", "surface voxels with their materials"};
    VoxelBuilder builder_{*this, makeVoxelizer(), params_.visibilityRays};
};

std::unique_ptr<TriangleVoxelizer> VoxelizePass::makeVoxelizer() {
    switch (params_.method) {
        case VoxelizeMethod::DominantAxis:
            return makeDominantAxisVoxelizer();
        case VoxelizeMethod::HardwareConservative:
            return makeHardwareConservativeVoxelizer();
        case VoxelizeMethod::Multisampled:
            return makeMultisampledVoxelizer(params_.msaaSamples);
        case VoxelizeMethod::ThreeAxis:
            return makeThreeAxisVoxelizer(params_.samplesPerVoxelEdge);
        default:
            return makeExactVoxelizer();
    }
}

void VoxelizePass::plan(PassPlan& plan) {
    const Geometry& geometry = plan.frame.scene->geometry;
    SurfaceVoxels& v = plan[voxels_];
    v.areasAreUnoccluded = params_.visibilityRays > 0;
    v.grid = makeVoxelGrid(geometry.region.min, geometry.region.max, params_.resolution);
    v.grid.directions = params_.directions;
    v.estimatedCount = estimateVoxels(geometry, v.grid);
    plan.estimate(v.estimatedCount * sizeof(gpu::PackedVoxelMaterial));
    plan.buffer(v.levels, "grid of voxels", sizeof(gpu::VoxelLevel));
    VoxelBuilder::planVoxels(plan, v);
    builder_.planWork(plan);
}

void VoxelizePass::record(PassContext& context) {
    SurfaceVoxels& v = context[voxels_];
    const std::optional<std::vector<Box>>& changed = context.frame.changedRegions;
    if (!changed || !v.materials)
        builder_.build(context, v);
    else if (!changed->empty())
        builder_.update(context, VoxelRegion(v.grid, changedVoxels(v.grid, *changed)), v);
    else
        context.markOutputsUnchanged();
    if (v.voxelCount == 0)
        throw Error(
            "voxelize: no surface meets the grid of {}x{}x{} voxels; "
            "the scene needs triangles with an area, and three_axis more 'samples_per_voxel_edge'",
            v.grid.resolution.x, v.grid.resolution.y, v.grid.resolution.z);
}

VOXRAY_REGISTER_PASS(VoxelizePass);

}  // namespace voxray
