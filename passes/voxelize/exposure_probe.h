#pragma once

#include "passes/common/voxels.h"

namespace voxray {

/// Finds how much of each voxel's surface has open space before it.
///
/// Thin walls, slabs and cloth are closed shells: their inner sides take no light, but they face the same way
/// as an outer side in the same voxel and would halve its mean irradiance. Points spread evenly over all
/// surfaces send one ray along the normal from either side; a side is exposed if nothing lies within one
/// voxel. Sides of a gap narrower than a voxel count as hidden.
class ExposureProbe {
 public:
    ExposureProbe() = default;
    ExposureProbe(Device& device, const ShaderCompiler& compiler);

    /// @param pointsPerVoxel points for each surface voxel on average.
    /// @return 9 uints a voxel, as resolve.comp reads them.
    Buffer run(PassContext& context, const SurfaceVoxels& voxels, uint32_t pointsPerVoxel) const;

 private:
    Program emit_, count_;
};

}  // namespace voxray
