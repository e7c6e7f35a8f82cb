#pragma once

#include "graph/pass.h"
#include "passes/common/view/gather_hits.h"
#include "passes/common/view/gbuffer.h"
#include "passes/common/voxels/voxels.h"
#include "passes/surfels/surfels.h"

namespace voxray {

/// Selects the surfels on faces of voxels that the frame's gather rays will read.
class HitFaces {
 public:
    explicit HitFaces(ProgramOwner& owner);

    void plan(PassPlan& plan);
    /// Marks the faces that are read at the hits.
    void mark(PassContext& context, const SurfaceVoxels& voxels, const Surfels& surfels, const GBuffer& gbuffer,
              const GatherHits& hits);
    /// Selects the surfels of a chunk on marked faces. @return their number. Waits for the device.
    uint32_t select(PassContext& context, const Surfels::Chunk& chunk) const;
    /// The surfels that were selected last.
    const Buffer& selected() const { return selected_; }

 private:
    Kernel markSurfelFaces_, markHitFaces_, select_;
    Buffer selected_, count_;             ///< Selected surfels of a chunk.
    Buffer hitFaces_, facesWithSurfels_;  ///< One bit per face, in one word per voxel.
};

}  // namespace voxray
