#include "passes/common/voxel_lookup.h"

#include "passes/common/dispatch.h"
#include "passes/common/frame_image.h"

namespace voxray {
namespace {

struct Push {
    gpu::VoxelGrid grid;
    float radius;
    uint32_t samples;
};

}  // namespace

VoxelLookup::VoxelLookup(Device& device, const ShaderCompiler& compiler)
    : program_(makeComputeProgram(device, compiler.compile("passes/common/voxel_lookup.comp"))),
      sampler_(texelSampler(device)) {}

void VoxelLookup::run(CommandStream& stream, const GBuffer& gbuffer, const SurfaceVoxels& voxels,
                      const Buffer& flux, const Buffer& area, const Image& target, float radius) const {
    stream.dispatch(program_,
                    {{"position", gbuffer.position, sampler_},
                     {"normal", gbuffer.normal, sampler_},
                     {"albedo", gbuffer.albedo, sampler_},
                     {"voxelOccupancy", voxels.occupancy},
                     {"voxelRank", voxels.rank},
                     {"voxelFlux", flux},
                     {"voxelArea", area},
                     {"result", target}},
                    Push{voxels.grid, radius, gbuffer.samples},
                    pixelGroups(target.desc().extent.x, target.desc().extent.y));
}

}  // namespace voxray
