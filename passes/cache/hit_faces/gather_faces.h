#pragma once

#include <vector>

#include "passes/cache/hit_faces/new_faces.h"
#include "passes/common/view/gather_hits.h"
#include "passes/common/view/gbuffer.h"

namespace voxray {

/// The faces that a frame's gather rays hit.
class GatherFaces {
 public:
    GatherFaces(ProgramOwner& owner, FaceKind kind) : mark_(owner, "mark_gather_hits.comp", definesOf(kind)) {}

    /// @return the number of gather rays.
    uint64_t plan(PassPlan& plan, const GatherHits& hits);
    /// Marks the hit faces that have no number. @param store what hit_face.glsl reads. @return the hits, by batch.
    std::vector<FaceHits> mark(PassContext& context, const GatherHits& hits, const GBuffer& gbuffer,
                               const std::vector<Binding>& store, const HitFaceLight& light, const NewFaces& newFaces);

 private:
    Kernel mark_;
    std::vector<Buffer> faces_;  ///< By batch and ray.
};

}  // namespace voxray
