#pragma once

#include "passes/common/voxels/voxels.h"

namespace voxray {

/// The irradiance of each voxel's six faces, ready for lookups by many rays
/// (shaders/voxels/face_irradiance.glsl). 6 x (W/m², area in voxel faces) as 24 floats a voxel.
class FaceIrradiance {
 public:
    explicit FaceIrradiance(ProgramOwner& owner);

    /// Divides flux, and with `added` the sum of both, by area; allocates on the first call and where the
    /// number of voxels has changed. @param area, flux: as VoxelIrradiance holds them.
    void update(CommandStream& stream, const SurfaceVoxels& voxels, const Buffer& area,
                const LargeBuffer& flux, const LargeBuffer* added = nullptr);
    /// Frees the irradiance, once the stream has finished.
    void end() { faces_ = {}; }
    Binding binding() const { return {"FaceIrradianceRef", faces_.ref()}; }

 private:
    Kernel program_;
    LargeBuffer faces_;
};

}  // namespace voxray
