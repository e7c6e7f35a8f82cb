#pragma once

#include <vector>

#include "passes/common/voxels/voxels.h"

namespace voxray {

/// Finds how much of each voxel's surface has open space before it.
///
/// Thin walls, slabs and cloth are closed shells: their inner sides take no light, but they face the same way
/// as an outer side in the same voxel and would halve its mean irradiance. Points spread evenly over all
/// surfaces send one ray along the normal from either side; a side is exposed if nothing lies within one
/// voxel. Sides of a gap narrower than a voxel count as hidden. A triangle's points depend on that triangle
/// alone: what moves elsewhere does not move them.
class VisibilityProbe {
 public:
    VisibilityProbe() = default;
    VisibilityProbe(Device& device, const ShaderCompiler& compiler);

    /// Probes from the points of `triangles` that lie in one of `voxels`.
    /// @param pointsPerFace points for as much area as a voxel's face has.
    /// @return 9 uints a voxel, as resolve.comp reads them.
    Buffer run(PassContext& context, const SurfaceVoxels& voxels, const std::vector<uint32_t>& triangles,
               uint32_t pointsPerFace) const;
    /// Bytes that run() takes for a while, with what it returns.
    static uint64_t bytes(uint32_t voxelCount, uint32_t pointsPerFace);

 private:
    Program emit_, count_;
};

}  // namespace voxray
