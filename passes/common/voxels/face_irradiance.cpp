#include "passes/common/voxels/face_irradiance.h"

namespace voxray {

FaceIrradiance::FaceIrradiance(ProgramOwner& owner) : program_(owner, "face_irradiance.comp") {}

void FaceIrradiance::update(CommandStream& stream, const SurfaceVoxels& voxels, const Buffer& area,
                            const LargeBuffer& flux, const LargeBuffer* added) {
    const uint32_t faces = voxels.voxelCount * kFaces;
    ensureSize(faces_, stream.device(), "face irradiance", uint64_t(faces) * 4 * sizeof(float));
    stream.dispatch(program_, faces,
                    {{"FluxRef", flux.ref()},
                     {"AddedRef", (added ? *added : flux).ref()},
                     {"area", area},
                     {"FacesRef", faces_.ref()},
                     {"count", faces},
                     {"voxelFaceArea", voxels.grid.voxelSize * voxels.grid.voxelSize},
                     {"addedWeight", added ? 1.0f : 0.0f}});
}

}  // namespace voxray
