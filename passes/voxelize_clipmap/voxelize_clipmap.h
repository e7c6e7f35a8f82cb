#pragma once

#include "passes/common/clipmap/clipmap_voxels.h"
#include "passes/common/voxel_builder/voxel_builder.h"

namespace voxray {

/// Turns triangles into the surface voxels of a clipmap. Windows follow the camera: what scrolls in is
/// voxelized, and where surfaces moved what they touched, before and after. Docs: docs/clipmap.md.
class VoxelizeClipmap final : public Pass {
 public:
    static constexpr const char* kName = "voxelize_clipmap";
    static constexpr const char* kHelp =
        "Turns the scene into surface voxels round the camera: large ones for all of it, on each finer level "
        "those of a window. Takes memory by the windows, not by the scene, but for 8 bytes a triangle or "
        "more. In each frame voxelizes what "
        "scrolled in, and what moved. For light_clipmap. Finds voxels as voxelize's method exact. Biased by: "
        "distance from the camera; a gap narrower than a voxel of its level is closed. "
        "Source: Arnebäck 2017, section 4.1.1, after Panteleev 2014.";
    struct Params : ClipmapParams, VoxelBuildParams {
        uint32_t resolution = 128;
        static constexpr auto schema() {
            return std::tuple_cat(
                std::tuple{field("resolution", &Params::resolution,
                                 "Voxels of the finest level along the scene's longest side, if it were held "
                                 "whole.",
                                 1u, 1024u)},
                ClipmapParams::schema(), VoxelBuildParams::schema());
        }
    };

    explicit VoxelizeClipmap(const Params& params);
    Phase phase() const override { return Phase::Frame; }
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    Params params_;
    Port<ClipmapVoxels> clipmap_;
    VoxelBuilder builder_;
    std::vector<gpu::ClipmapWindow> windows_;  ///< By level, as they were in the last frame.
    uint64_t sceneVersion_ = 0;                ///< Likewise.
};

}  // namespace voxray
