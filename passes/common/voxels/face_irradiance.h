#pragma once

#include "passes/common/voxels/voxels.h"

namespace voxray {

/// Irradiance of each voxel's six faces for lookups at many hits (shaders/voxels/face_irradiance.glsl): RGB,
/// W/m², and area in voxel faces, 24 floats per voxel.
class FaceIrradiance {
 public:
    explicit FaceIrradiance(ProgramOwner& owner) : program_(owner, "face_irradiance.comp") {}

    /// Divides flux, or the sum of `flux` and `added`, by area. Reallocates when the number of voxels has
    /// changed. @param area, flux, added as in VoxelIrradiance.
    void update(CommandStream& stream, const VoxelLevels& voxels, const Buffer& area, const LargeBuffer& flux,
                const LargeBuffer* added = nullptr) {
        const uint32_t faces = voxels.voxelCount * kFaces;
        ensureSize(faces_, stream.device(), "face irradiance", uint64_t(faces) * 4 * sizeof(float));
        stream.dispatch(program_, faces,
                        {voxels,
                         {"FluxRef", flux.ref()},
                         {"AddedRef", (added ? *added : flux).ref()},
                         {"area", area},
                         {"FacesRef", faces_.ref()},
                         {"count", faces},
                         {"addedWeight", added ? 1.0f : 0.0f}});
    }
    /// Frees the irradiance, once the stream has finished.
    void end() { faces_ = {}; }
    Binding binding() const { return {"FaceIrradianceRef", faces_.ref()}; }

 private:
    Kernel program_;
    LargeBuffer faces_;
};

}  // namespace voxray
