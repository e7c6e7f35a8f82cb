#pragma once

#include <optional>
#include <string>

#include "passes/common/voxels/voxel_accumulator.h"
#include "passes/surfels/surfel_paths.h"

namespace voxray {

/// Light of surfels into voxels: sums of their direct and indirect irradiance, by face, and what becomes of
/// these.
class SurfelInjection {
 public:
    explicit SurfelInjection(ProgramOwner& owner);

    /// Estimates the result's memory. @throws Error naming `pass` for what the device can't do.
    void plan(PassPlan& plan, const std::string& pass, const WriteParams& params,
              const SurfaceVoxels& voxels);

    /// Allocates the result and the sums, and clears them.
    void begin(PassContext& context, const PathScene& scene, VoxelIrradiance& irradiance);
    /// Leaves irradiance of surfels in their voxels. @param irradiance W/m², 4 floats each.
    void writeDirect(PassContext& context, const Buffer& surfels, uint32_t count,
                     const Buffer& irradiance) const;
    void writeIndirect(PassContext& context, const Buffer& surfels, uint32_t count,
                       const Buffer& irradiance) const;
    /// Fills the result and frees the sums. Faces without surfels stay unknown. Waits for the device.
    void finish(PassContext& context, const SurfaceVoxels& voxels, const VoxelIrradiance& irradiance);
    /// Gives faces without surfels the mean of the voxels around them.
    void fillUnknown(PassContext& context, const SurfaceVoxels& voxels,
                     const VoxelIrradiance& irradiance) const;

 private:
    void write(PassContext& context, const VoxelAccumulator& sums, const Buffer& surfels, uint32_t count,
               const Buffer& irradiance) const;

    ProgramOwner& owner_;
    std::optional<VoxelAccumulator> directSums_, indirectSums_;
    Kernel write_, fillUnknown_;
};

}  // namespace voxray
