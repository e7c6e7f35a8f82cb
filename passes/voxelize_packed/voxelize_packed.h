#pragma once

#include <memory>

#include "passes/common/packed_voxels/packed_voxels.h"
#include "passes/common/triangle_walk/triangle_walk.h"

namespace voxray {

/// Voxelization as published in Magalhães 2020, sections 3.2.4.2 and 4.2: triangles are drawn along each axis
/// onto an image of a pixel a voxel or more, and each fragment merges its normal and its albedo into its
/// voxel's words. The thesis's other volumes (occupancy, specular) are left out: nothing there reads them.
class VoxelizePacked final : public Pass {
 public:
    static constexpr const char* kName = "voxelize_packed";
    static constexpr const char* kHelp =
        "Turns triangles into volumes of one RGBA8 word a voxel, without faces: the mean normal and the mean "
        "albedo. As published in Magalhães 2020 (sections 3.2.4.2 and 4.2), for comparison: voxelize is the "
        "method to use. Biased by: voxel size; surfaces whose sides share a voxel, whose normals cancel out; "
        "surfaces between pixel centers, which are missed; 8 bits. Noisy by: nothing, but moving_average and "
        "none depend on the order of threads. Source: Magalhães 2020, section 4.2.";
    struct Params : PackedWriteParams {
        uint32_t resolution = 128;
        uint32_t samplesPerVoxelEdge = 1;
        static constexpr auto schema() {
            return std::tuple_cat(std::tuple{field("resolution", &Params::resolution,
                                                   "Voxels along the scene's longest side.", 1u, 1024u),
                                             field("samples_per_voxel_edge", &Params::samplesPerVoxelEdge,
                                                   "Pixels along a voxel's edge, in each of the three "
                                                   "projections: 1 as published, more miss less.",
                                                   1u, 16u)},
                                  PackedWriteParams::schema());
        }
    };

    explicit VoxelizePacked(const Params& params)
        : params_(params), walk_(makeThreeAxisWalk(params.samplesPerVoxelEdge)) {}
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    Params params_;
    std::unique_ptr<TriangleWalk> walk_;
    Port<PackedVoxels> voxels_;
    Program write_;
};

}  // namespace voxray
