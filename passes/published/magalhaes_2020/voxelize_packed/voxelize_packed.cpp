#include <memory>
#include <vector>

#include "graph/registry.h"
#include "passes/common/triangle_voxelizer/triangle_voxelizer.h"
#include "passes/common/voxels/voxels.h"
#include "passes/published/magalhaes_2020/packed_voxels.h"

namespace voxray {

/// Voxelization as published in Magalhães 2020, sections 3.2.4.2 and 4.2: triangles are rasterized along each
/// axis at one pixel per voxel or more, and each fragment merges its normal and albedo into its voxel's
/// words. The thesis's other volumes (occupancy, specular) are omitted: nothing reads them there.
class VoxelizePacked final : public Pass {
 public:
    static constexpr const char* kName = "voxelize_packed";
    static constexpr bool kDependsOnLight = false;
    static constexpr const char* kHelp =
        "Voxelizes triangles into packed volumes of one RGBA8 word a voxel. "
        "The volumes hold the mean normal and the mean albedo, without faces. "
        "As published in Magalhães 2020 (sections 3.2.4.2 and 4.2), for comparison: use voxelize instead. "
        "Biased by: voxel size; opposite surfaces in a voxel, whose normals cancel out; "
        "surfaces between pixel centers, which are missed; 8 bits. Noisy by: "
        "nothing, but moving_average and none depend on the order of threads. Source: Magalhães 2020, section 4.2.";
    struct Params : PackedWriteParams {
        uint32_t resolution = 128;
        uint32_t samplesPerVoxelEdge = 1;
        static constexpr auto schema() {
            return std::tuple_cat(
                std::tuple{
                    field("resolution", &Params::resolution, "Voxels along the scene's longest side.", 1u, 1024u),
                    field("samples_per_voxel_edge", &Params::samplesPerVoxelEdge,
                          "Pixels along a voxel's edge in each of the three projections: 1 as published; "
                          "with more, fewer surfaces are missed.",
                          1u, 16u)},
                PackedWriteParams::schema());
        }
    };

    explicit VoxelizePacked(const Params& params) : params_(params) {}
    void plan(PassPlan& plan) override {
        const Geometry& geometry = plan.frame.scene->geometry;
        PackedVoxels& voxels = plan[voxels_];
        voxels.grid = makeVoxelGrid(geometry.region.min, geometry.region.max, params_.resolution);
        plan.buffer(voxels.normals, "packed normals", voxels.bytes());
        plan.buffer(voxels.albedos, "packed albedos", voxels.bytes());
        voxelizer_->plan(plan);
    }
    void record(PassContext& context) override {
        const PackedVoxels& voxels = context[voxels_];
        context.stream.fill(voxels.normals, 0);
        context.stream.fill(voxels.albedos, 0);

        // All triangles are voxelized in each update, as published
        const VoxelRegion wholeGrid(voxels.grid);
        voxelizer_->select(context, voxels.grid, wholeGrid, wholeGrid.triangles(context.frame.scene->geometry));
        const std::vector<Binding> volumes{{"NormalsRef", voxels.normals.ref()}, {"AlbedosRef", voxels.albedos.ref()}};
        voxelizer_->run(context, *write_, voxels.grid, volumes, 0);
        context.stream.finish();
        voxelizer_->release();
    }

 private:
    const Params params_;
    Out<PackedVoxels> voxels_{*this, "packed_voxels", "normals and albedos, one word a voxel"};
    std::unique_ptr<TriangleVoxelizer> voxelizer_ = makeThreeAxisVoxelizer(params_.samplesPerVoxelEdge);
    std::unique_ptr<PassProgram> write_ = voxelizer_->makeProgram(
        *this, "passes/published/magalhaes_2020/voxelize_packed/voxelize_packed", params_.defines());
};
VOXRAY_REGISTER_PASS(VoxelizePacked);

}  // namespace voxray
