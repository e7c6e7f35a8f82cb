#pragma once

#include "graph/pass.h"
#include "passes/common/compute/large_buffer.h"

namespace voxray {

/// The points of place_surfels without what follows from the scene: 4.5 bytes a point, where its two surfels take 104.
/// Positions, normals and reflectances are evaluated where they are read (surfel_points.glsl). A surfel's id is
/// 2 * point + side.
struct SurfelPoints : Resource {
    std::string indexedBy() const override { return "voxels"; }

    uint32_t count = 0;               ///< Points; each has at most one surfel on either side.
    uint32_t seed = 0;                ///< Of their places on their triangles.
    LargeBuffer triangles;            ///< Triangle of each point; uint32_t.
    LargeBuffer sides;                ///< Two bits for each surfel, by id: SURFEL_NONE, _OPEN or _OCCLUDED.
    bool hasOccludedSurfels = false;  ///< Set in plan().

    /// The bindings of surfel_points.glsl except those of the scene.
    std::vector<Binding> bindings() const { return {{"PointTrianglesRef", triangles.ref()}, {"pointSeed", seed}}; }
};

}  // namespace voxray
