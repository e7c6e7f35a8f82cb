#pragma once

#include <vector>

#include "passes/common/voxels/voxels.h"

namespace voxray {

/// Computes the unoccluded fraction of each voxel's surface, by the voxel's six faces.
///
/// Walls, slabs and cloth are closed shells, often thinner than a voxel. The insides of a shell receive no
/// light, but share the voxel's faces with its outsides. Divided by the area of both, irradiance would be
/// half of what it is.
///
///        +-----------------+
///        |        |        |    A probe is a point on a surface with two rays to it, from a voxel's width in
///        |        v        |    front of it and behind it. The upper side of this face is visible. The lower
///     ===|========o========|===   side is not: the ray to it hits the slab's other face first.
///        |                 |
///     ===|========o========|===  slab
///        +--------^--------+  voxel
///
/// Probes are distributed uniformly over all surfaces. The visible fraction of a face's area is
///
///     sum of n_a² over the points whose side towards the face is visible / sum of n_a² over all points
///
/// with a the axis of the face and n a point's unit normal, since a surface of area A has an area of A n_a²
/// at the face. Of coincident surfaces that face the same way a ray hits one, so that their area counts once.
/// Gaps narrower than a voxel count as closed. A triangle's probes depend on where that triangle is and on nothing
/// else: they don't change when other surfaces move, and copies of a triangle in the same place have the same ones.
class VisibilityProbe {
 public:
    explicit VisibilityProbe(ProgramOwner& owner);

    /// Tests the probes of `triangles` that are in `voxels`. @param pointsPerFace per area of a voxel's face.
    /// @return 9 uints per voxel (count_visible_points.comp); 0 for voxels without probes.
    /// @throws Error where a voxel has more probes than its counts hold.
    Buffer run(PassContext& context, const SurfaceVoxels& voxels, const std::vector<uint32_t>& triangles,
               uint32_t pointsPerFace) const;

 private:
    Kernel generateRays_, count_;
};

}  // namespace voxray
