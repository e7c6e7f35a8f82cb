#pragma once

#include <vector>

#include "passes/common/voxels/voxels.h"

namespace voxray {

/// Finds how much of each voxel's surface is visible, that is, has open space in front of it, by the voxel's
/// six faces.
///
/// Walls, slabs and cloth are closed shells, often thinner than a voxel. No light gets inside the shell, but
/// its inner sides share a voxel with the outer sides and turn to the same faces. Light over the area of both
/// would be half as bright as it is:
///
///        +-----------------+
///        |        |        |    A probe is a point on a surface with two rays to it, from a voxel's length
///        in |        v free   |    front of it and behind it. The upper side of this slab is visible. Its
///        lower
///     ===|========o========|===   side is not: the ray to it meets the slab's other face before.
///        |                 |
///     ===|========o========|===  slab
///        +--------^--------+  voxel
///
/// Probes are spread evenly over all surfaces. By face, the visible fraction of the area is
///
///     Σ of n_a² over the points whose side towards the face is visible / Σ of n_a² over all points
///
/// with a the axis of the face and n a point's unit normal, as a surface of area A counts A n_a² at the face.
/// Where surfaces that face the same way coincide, a ray meets one of them, so that their area counts once:
/// a triangle that is there twice has the area of one. Gaps narrower than a voxel count as closed. A
/// triangle's probes depend on that triangle alone: they stay where they are when other surfaces move.
class VisibilityProbe {
 public:
    explicit VisibilityProbe(ProgramOwner& owner);

    /// Probes the points of `triangles` that lie in one of `voxels`.
    /// @param pointsPerFace points for as much area as a voxel's face has.
    /// @return 9 uints a voxel, as visibility_count.comp adds them up; all 0 without points.
    Buffer run(PassContext& context, const SurfaceVoxels& voxels, const std::vector<uint32_t>& triangles,
               uint32_t pointsPerFace) const;

 private:
    Kernel emit_, count_;
};

}  // namespace voxray
