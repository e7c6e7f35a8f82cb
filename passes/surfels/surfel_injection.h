#pragma once

#include <optional>
#include <string>

#include "passes/common/voxels/voxel_accumulator.h"
#include "passes/surfels/surfel_paths.h"

namespace voxray {

/// Accumulates the direct and the indirect irradiance of surfels in the faces of their voxels.
class SurfelInjection {
 public:
    explicit SurfelInjection(ProgramOwner& owner);

    /// Estimates the result's memory. @throws Error naming `pass` for what the device lacks.
    void plan(PassPlan& plan, const std::string& pass, const WriteParams& params, const SurfaceVoxels& voxels);

    /// Allocates and clears the result and the accumulators.
    void begin(PassContext& context, const PathScene& scene, VoxelIrradiance& irradiance);
    /// Adds the irradiance of `count` surfels, W/m², 4 floats each.
    void writeDirect(PassContext& context, const Buffer& surfels, uint32_t count, const Buffer& irradiance) const;
    void writeIndirect(PassContext& context, const Buffer& surfels, uint32_t count, const Buffer& irradiance) const;
    /// Fills the result and frees the accumulators. Faces without surfels stay unknown. Waits for the device.
    void finish(PassContext& context, const SurfaceVoxels& voxels, const VoxelIrradiance& irradiance);
    /// Gives faces without surfels the mean of the adjacent voxels' faces. Waits for the device.
    void fillUnknown(PassContext& context, const SurfaceVoxels& voxels, const VoxelIrradiance& irradiance) const;

 private:
    void write(PassContext& context, const VoxelAccumulator& accumulator, const Buffer& surfels, uint32_t count,
               const Buffer& irradiance) const;

    ProgramOwner& owner_;
    std::optional<VoxelAccumulator> direct_, indirect_;
    Kernel write_, fillUnknown_;
};

}  // namespace voxray
