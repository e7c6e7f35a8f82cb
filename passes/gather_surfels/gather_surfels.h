#pragma once

#include "passes/common/surfels/surfels_by_voxel.h"
#include "passes/common/view/frame_image.h"
#include "passes/common/view/gbuffer.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {

/// Indirect light per pixel from the surfels around it: albedo / pi times the mean of their irradiance,
/// weighted by how far each speaks for the pixel's surface. Voxels only tell which surfels are near. Source:
/// Ward, Rubinstein and Clear 1988 (irradiance of points on surfaces, interpolated); docs/radiosity.md.
class GatherSurfels final : public Pass {
 public:
    static constexpr const char* kName = "gather_surfels";
    static constexpr const char* kHelp =
        "Indirect light: the mean irradiance of the surfels in the eight voxels around each pixel's surface, "
        "those of the same plane before others. Tells two surfaces in one voxel apart. Biased by: the "
        "distance of "
        "surfels. Noisy by: points_per_voxel, rays_per_surfel. Lambert surfaces only. Source: Ward, "
        "Rubinstein and Clear 1988.";
    struct Params {
        static constexpr auto schema() { return std::tuple{}; }
    };

    explicit GatherSurfels(const Params&) {}
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    Port<const GBuffer> gbuffer_;
    Port<const SurfaceVoxels> voxels_;
    Port<const VoxelIrradiance> irradiance_;
    Port<const SurfelsByVoxel> surfels_;
    Port<const SurfelIrradiance> light_;
    Port<FrameImage> indirect_;
    bool probed_ = false;  ///< Whether covered surfaces have surfels of their own.
    uint32_t samples_ = 1, bandRows_ = 1;
    Program gather_, resolve_;
    Buffer count_, first_;                 ///< Scratch: of undecided surfaces, in all and by pixel of a band.
    Buffer undecided_, probes_, covered_;  ///< Scratch, of each undecided surface.
    Sampler sampler_;
};

}  // namespace voxray
