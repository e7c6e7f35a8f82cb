#include "passes/common/voxels/face_irradiance.h"

#include "passes/common/compute/dispatch.h"

namespace voxray {
namespace {

struct FaceIrradiancePush {
    uint32_t count;
    float voxelFaceArea;
    float addedWeight;
};

}  // namespace

FaceIrradiance::FaceIrradiance(Device& device, const ShaderCompiler& compiler)
    : program_(makeComputeProgram(device, compiler.compile("passes/common/voxels/face_irradiance.comp"))) {}

void FaceIrradiance::update(CommandStream& stream, const SurfaceVoxels& voxels, const Buffer& area,
                            const LargeBuffer& flux, const LargeBuffer* added) {
    makeOrKeep(faces_, stream.device(), "face irradiance", bytes(voxels.voxelCount));
    const uint32_t faces = voxels.voxelCount * kFaces;
    stream.dispatch(
        program_,
        {{"FluxAt", flux.at()},
         {"AddedAt", (added ? *added : flux).at()},
         {"area", area},
         {"FacesAt", faces_.at()}},
        FaceIrradiancePush{faces, voxels.grid.voxelSize * voxels.grid.voxelSize, added ? 1.0f : 0.0f},
        linearGroups(faces));
}

}  // namespace voxray
