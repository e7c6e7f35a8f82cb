#pragma once

#include "passes/cones/filter_voxels/radiance_storage.h"

namespace voxray {

/// Voxels of a grid.
uint64_t voxelsOf(glm::uvec3 resolution);

/// Fills full grids level by level, for any layout whose shader defines what docs/writing-a-pass.md lists.
class DenseFill {
 public:
    explicit DenseFill(ProgramOwner& owner);

    /// @param radiance with its layout.
    void plan(const RadianceVoxels& radiance);
    /// @param emission 1 to add what surfaces emit, 0 not to.
    void run(CommandStream& stream, const SurfaceVoxels& voxels, const SurfaceLight& light,
             const RadianceVoxels& radiance, float emission) const;

 private:
    Kernel surface_, level_;
};

}  // namespace voxray
