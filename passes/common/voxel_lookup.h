#pragma once

#include "passes/common/gbuffer.h"
#include "passes/common/voxels.h"

namespace voxray {

/// Light reflected at every pixel's surface, albedo / pi times the irradiance that voxels hold there: what
/// gather_irradiance (indirect flux) and direct_voxels (direct flux) share.
class VoxelLookup {
 public:
    VoxelLookup() = default;
    VoxelLookup(Device& device, const ShaderCompiler& compiler);

    /// @param flux VoxelIrradiance::direct or ::indirect. @param radius reach of the interpolation in voxels.
    void run(CommandStream& stream, const GBuffer& gbuffer, const SurfaceVoxels& voxels, const Buffer& flux,
             const Buffer& area, const Image& target, float radius) const;

 private:
    Program program_;
    Sampler sampler_;
};

}  // namespace voxray
